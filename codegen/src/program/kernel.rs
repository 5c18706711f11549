//! Straight-line code in one angle that gives its sine and cosine.
//!
//! A kernel is what is printed, read back, run and proved: one operation a
//! step, literals as they stand in the text. Which kind of polynomial it is
//! does not matter to any of these.

use super::machine::Machine;
use super::{Literal, Operand, Operation, Output, Step, evaluate};

/// The one input of a kernel: its angle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Angle;

/// An operand of a kernel's step.
pub type Term = Operand<Literal, Angle>;

/// The angle as an operand.
pub(crate) const ANGLE: Term = Operand::Input(Angle);

/// A kernel's step.
pub(crate) type KernelStep = Step<Literal, Angle>;

/// A kernel's result.
pub(crate) type Value = Output<Literal, Angle>;

/// Returns a literal as an operand.
pub(crate) fn literal(value: f64) -> Term {
    Operand::Constant(Literal(value))
}

/// The code of one angle.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Kernel {
    /// Operands before users.
    pub steps: Vec<KernelStep>,
    /// The sine, if it is wanted.
    pub sin: Option<Value>,
    /// The cosine, if it is wanted.
    pub cos: Option<Value>,
}

impl Kernel {
    /// Appends an operation.
    pub fn push(&mut self, operation: Operation, left: Term, right: Term) -> Term {
        self.steps.push(Step {
            operation,
            left,
            right,
        });
        Term::Step(self.steps.len() - 1)
    }

    /// Returns left·right
    pub fn mul(&mut self, left: Term, right: Term) -> Term {
        self.push(Operation::Mul, left, right)
    }

    /// Returns left + literal; a negative literal is subtracted, which is the same.
    pub fn add_literal(&mut self, left: Term, value: f64) -> Term {
        if value < 0.0 {
            self.push(Operation::Sub, left, literal(-value))
        } else {
            self.push(Operation::Add, left, literal(value))
        }
    }

    /// Returns Σ c_k·x^k by Horner's scheme; the constant alone is a literal.
    pub fn horner(&mut self, x: Term, coefficients: &[f64]) -> Term {
        let mut coefficients = coefficients.iter().rev();
        let Some(&first) = coefficients.next() else {
            return literal(0.0);
        };
        let mut sum = literal(first);
        for &c in coefficients {
            let product = self.mul(x, sum);
            // A coefficient that vanishes by symmetry takes no addition.
            sum = if c == 0.0 {
                product
            } else {
                self.add_literal(product, c)
            };
        }
        sum
    }

    /// Multiplications and additions.
    pub fn counts(&self) -> (usize, usize) {
        let is_mul = |step: &&KernelStep| step.operation == Operation::Mul;
        let mul = self.steps.iter().filter(is_mul).count();
        (mul, self.steps.len() - mul)
    }

    /// Multiplications and additions together.
    pub fn operations(&self) -> usize {
        self.steps.len()
    }

    /// Leaves out what neither result needs.
    #[must_use]
    pub fn without_dead(&self) -> Kernel {
        let mut live = vec![false; self.steps.len()];
        let mark = |live: &mut Vec<bool>, term: Term| {
            if let Term::Step(step) = term {
                live[step] = true;
            }
        };
        for value in [self.sin, self.cos].into_iter().flatten() {
            mark(&mut live, value.value);
        }
        for index in (0..self.steps.len()).rev() {
            if live[index] {
                mark(&mut live, self.steps[index].left);
                mark(&mut live, self.steps[index].right);
            }
        }
        let mut place = Vec::with_capacity(self.steps.len());
        let mut kernel = Kernel::default();
        let moved = |place: &[usize], term: Term| match term {
            Term::Step(step) => Term::Step(place[step]),
            other => other,
        };
        for (step, live) in self.steps.iter().zip(live) {
            place.push(kernel.steps.len());
            if live {
                let (left, right) = (moved(&place, step.left), moved(&place, step.right));
                kernel.push(step.operation, left, right);
            }
        }
        let value = |value: Option<Value>| {
            value.map(|value| Value {
                value: moved(&place, value.value),
                ..value
            })
        };
        (kernel.sin, kernel.cos) = (value(self.sin), value(self.cos));
        kernel
    }

    /// Runs it bit for bit. A result that is not wanted, or of a step that is
    /// not there, is the angle.
    pub fn run<T: Machine>(&self, angle: T) -> (T, T) {
        let unwanted = Value::of(ANGLE);
        let results = [&self.sin, &self.cos].map(|value| value.as_ref().unwrap_or(&unwanted));
        let constant = |value: &Literal| Some(T::literal(value.0));
        let run = evaluate(&self.steps, results, |_| Some(angle), constant);
        match run.as_deref() {
            Some(&[sin, cos]) => (sin, cos),
            _ => (angle, angle),
        }
    }
}
