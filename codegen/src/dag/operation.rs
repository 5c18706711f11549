//! The inputs of a program, its operations in any scalar with derivatives, and counts of them.

use std::fmt;

use dalembert_model::number::Exact;
use dalembert_model::scalar::{Divide, Scalar};

use super::Dag;
use crate::function::Argument;

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Operation {
    Add,
    Sub,
    Mul,
    Div,
    /// left · right, not rounded: the sum or difference that takes it rounds once (`fusion`).
    Fused,
}

impl Operation {
    pub const ALL: [Operation; 5] = [
        Operation::Add,
        Operation::Sub,
        Operation::Mul,
        Operation::Div,
        Operation::Fused,
    ];

    pub fn from_symbol(symbol: char) -> Option<Operation> {
        let mut operations = Operation::ALL.into_iter();
        operations.find(|operation| operation.symbol() == symbol)
    }

    /// Returns its symbol, Rust's but for a fused product, which has none there.
    pub fn symbol(self) -> char {
        match self {
            Operation::Add => '+',
            Operation::Sub => '-',
            Operation::Mul => '*',
            Operation::Div => '/',
            Operation::Fused => '×',
        }
    }

    #[inline]
    pub fn apply<S: Divide>(self, left: &S, right: &S) -> S {
        match self {
            Operation::Add => left.add(right),
            Operation::Sub => left.sub(right),
            Operation::Mul | Operation::Fused => left.mul(right),
            Operation::Div => left.div(right),
        }
    }

    /// `None` for a quotient by zero, or by what is not a rational number.
    pub(crate) fn exactly(self, left: &Exact, right: &Exact) -> Option<Exact> {
        Some(match self {
            Operation::Add => left.add(right),
            Operation::Sub => left.sub(right),
            Operation::Mul | Operation::Fused => left.mul(right),
            Operation::Div => return left.divide(right.as_rational()?),
        })
    }

    pub(crate) fn commutes(self) -> bool {
        matches!(self, Operation::Add | Operation::Mul | Operation::Fused)
    }

    /// Returns the result's adjoint passed on to the left and to the right operand.
    #[inline]
    pub fn parts<S: Divide>(self, adjoint: &S, left: &S, right: &S) -> [S; 2] {
        match self {
            Operation::Add => [adjoint.clone(), adjoint.clone()],
            Operation::Sub => [adjoint.clone(), adjoint.neg()],
            Operation::Mul | Operation::Fused => [adjoint.mul(right), adjoint.mul(left)],
            // ∂(x/y) = ∂x/y − (x/y)·∂y/y
            Operation::Div => {
                let by_left = adjoint.div(right);
                let by_right = by_left.mul(&left.div(right)).neg();
                [by_left, by_right]
            }
        }
    }
}

/// An input of a program. Joints are zero-based.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Input {
    Sin(usize),
    Cos(usize),
    /// 1/√(q̇² + w²) of a joint with Coulomb friction, w being its width.
    PerSpeed(usize),
    /// An entry of an argument, of most a joint's; of q that of a prismatic joint.
    Entry(Argument, usize),
}

impl Input {
    pub(crate) fn name(self) -> String {
        match self {
            Input::Sin(joint) => format!("s{}", joint + 1),
            Input::Cos(joint) => format!("c{}", joint + 1),
            Input::PerSpeed(joint) => format!("r{}", joint + 1),
            Input::Entry(argument, index) => format!("{}[{index}]", argument.name()),
        }
    }

    pub fn argument(self) -> Argument {
        match self {
            Input::Sin(_) | Input::Cos(_) => Argument::Position,
            Input::PerSpeed(_) => Argument::Velocity,
            Input::Entry(argument, _) => argument,
        }
    }

    /// Returns the joint whose sine or cosine it is.
    pub fn angle(self) -> Option<usize> {
        match self {
            Input::Sin(joint) | Input::Cos(joint) => Some(joint),
            _ => None,
        }
    }
}

/// Operations of straight-line code. Negation and copies are free.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Counts {
    /// Multiplications.
    pub mul: usize,
    /// Additions, subtractions, doublings.
    pub add: usize,
    /// Fused multiply-adds, which are not among the multiplications and additions.
    pub fma: usize,
    /// Divisions.
    pub div: usize,
    /// Square roots.
    pub sqrt: usize,
    /// Sine and cosine evaluations: a pair for one angle, or one of the two.
    pub sincos: usize,
    /// Multiplications of the polynomials that give them; none if libm does.
    pub trig_mul: usize,
    /// Additions of these.
    pub trig_add: usize,
}

impl Counts {
    pub(crate) fn of_operations(operations: impl Iterator<Item = Operation>) -> Counts {
        let mut counts = Counts::default();
        for operation in operations {
            match operation {
                Operation::Mul => counts.mul += 1,
                Operation::Add | Operation::Sub => counts.add += 1,
                Operation::Div => counts.div += 1,
                Operation::Fused => counts.fma += 1,
            }
        }
        // A fused product is an operation with its sum.
        counts.add -= counts.fma;
        counts
    }

    pub(crate) fn with_speeds(self, speeds: usize) -> Counts {
        Counts {
            mul: self.mul + speeds,
            add: self.add + speeds,
            div: self.div + speeds,
            sqrt: self.sqrt + speeds,
            ..self
        }
    }

    /// Multiplications, additions, both in one and divisions, but those of sines' polynomials.
    pub fn operations(&self) -> usize {
        self.mul + self.add + self.fma + self.div
    }
}

impl<C, I> Dag<C, I> {
    pub(crate) fn arithmetic(&self) -> Counts {
        Counts::of_operations(self.operations().map(|(_, operation, _)| operation))
    }
}

impl fmt::Display for Counts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} mul, {} add", self.mul, self.add)?;
        let others = [(self.fma, "fma"), (self.div, "div"), (self.sqrt, "sqrt")];
        for (count, name) in others.into_iter().filter(|(count, _)| *count > 0) {
            write!(f, ", {count} {name}")?;
        }
        write!(f, ", {} sincos", self.sincos)?;
        if self.trig_mul + self.trig_add > 0 {
            let (mul, add) = (self.trig_mul, self.trig_add);
            write!(f, ", {mul} trig_mul, {add} trig_add")?;
        }
        Ok(())
    }
}
