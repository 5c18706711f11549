//! Straight-line code in one angle that gives its sine and cosine.
//!
//! A kernel is what is printed, read back, run and proved, with literals as they stand in the text.
//! Its kind of polynomial does not matter to any of these.

use super::machine::Machine;
use super::{Counts, Literal, Operation};
use crate::dag::{Dag, Edge, Id, Node, Writer};

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Angle;

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SinCosUse {
    pub sin: bool,
    pub cos: bool,
}

impl SinCosUse {
    pub(crate) const BOTH: SinCosUse = SinCosUse {
        sin: true,
        cos: true,
    };

    /// Returns the sine's item and the cosine's, from a list with the wanted ones alone.
    pub fn each<T>(self, wanted: impl IntoIterator<Item = T>) -> [Option<T>; 2] {
        let mut wanted = wanted.into_iter();
        [self.sin, self.cos].map(|is_wanted| if is_wanted { wanted.next() } else { None })
    }
}

#[derive(Clone, Debug, PartialEq)]
pub struct Kernel {
    pub need: SinCosUse,
    /// The operations; the results are the sine and the cosine, as far as they are wanted.
    pub dag: Dag<Literal, Angle>,
}

pub(crate) type KernelWriter = Writer<Literal, Angle>;

impl KernelWriter {
    pub(crate) fn angle(&mut self) -> Id {
        self.leaf(Node::Input(Angle))
    }

    pub(crate) fn literal(&mut self, value: f64) -> Id {
        self.leaf(Node::Constant(Literal(value)))
    }

    pub(crate) fn mul(&mut self, left: Id, right: Id) -> Id {
        self.apply(Operation::Mul, [left, right])
    }

    /// Returns left + literal; a negative literal is subtracted, which is the same.
    pub(crate) fn add_literal(&mut self, left: Id, value: f64) -> Id {
        let operation = match value < 0.0 {
            true => Operation::Sub,
            false => Operation::Add,
        };
        let literal = self.literal(value.abs());
        self.apply(operation, [left, literal])
    }

    /// Returns Σ c_k·x^k by Horner's scheme; the constant alone is a literal.
    pub(crate) fn horner(&mut self, x: Id, coefficients: &[f64]) -> Id {
        let mut coefficients = coefficients.iter().rev();
        let mut sum = self.literal(coefficients.next().copied().unwrap_or(0.0));
        for &c in coefficients {
            sum = self.mul(x, sum);
            // A coefficient that vanishes by symmetry takes no addition.
            if c != 0.0 {
                sum = self.add_literal(sum, c);
            }
        }
        sum
    }

    pub(crate) fn kernel(self, need: SinCosUse, results: [Edge; 2]) -> Kernel {
        let pairs = results.into_iter().zip([need.sin, need.cos]);
        let wanted = pairs.filter_map(|(result, is_wanted)| is_wanted.then_some(result));
        let graph = self.finish(wanted.collect());
        let dag = graph.map(|literal| *literal, |angle| *angle);
        Kernel { need, dag }
    }
}

impl Counts {
    #[must_use]
    pub fn with_kernels<'k>(mut self, kernels: impl Iterator<Item = &'k Kernel>) -> Counts {
        for (_, operation, _) in kernels.flat_map(|kernel| kernel.dag.operations()) {
            match operation {
                Operation::Mul => self.trig_mul += 1,
                _ => self.trig_add += 1,
            }
        }
        self
    }
}

impl Kernel {
    pub fn results(&self) -> [Option<Edge>; 2] {
        self.need.each(self.dag.outputs.iter().copied())
    }

    pub fn operations(&self) -> usize {
        self.dag.operations().count()
    }

    /// Runs it bit for bit. A result that is not wanted is the angle.
    pub fn run<T: Machine>(&self, angle: T) -> (T, T) {
        let literal = |literal: &Literal| T::literal(literal.0);
        let [sin, cos] = self.need.each(self.dag.run(&(literal, |_: Angle| angle)));
        (sin.unwrap_or(angle), cos.unwrap_or(angle))
    }
}
