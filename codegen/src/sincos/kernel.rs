//! Straight-line code in one angle that gives its sine and cosine.
//!
//! A kernel is what is printed, read back, run and proved: one operation a
//! step, literals as they stand in the text. Which kind of polynomial it is
//! does not matter to any of these.

use crate::schedule::Operation;
use crate::verify::interpret::Machine;

/// What a step reads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Term {
    /// The angle.
    Angle,
    /// A literal's value in the kernel's scalar, held exactly.
    Literal(f64),
    /// The result of an earlier step.
    Step(usize),
}

/// One rounded operation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// What is done.
    pub operation: Operation,
    /// Left operand.
    pub left: Term,
    /// Right operand.
    pub right: Term,
}

/// A result, negated or not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Value {
    /// Whether it is negated.
    pub negative: bool,
    /// The value.
    pub term: Term,
}

/// The code of one angle.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Kernel {
    /// Operands before users.
    pub steps: Vec<Step>,
    /// The sine, if it is wanted.
    pub sin: Option<Value>,
    /// The cosine, if it is wanted.
    pub cos: Option<Value>,
}

impl Value {
    /// A value as it is.
    pub fn of(term: Term) -> Value {
        Value {
            negative: false,
            term,
        }
    }
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

    /// left·right
    pub fn mul(&mut self, left: Term, right: Term) -> Term {
        self.push(Operation::Mul, left, right)
    }

    /// left + literal; a negative literal is subtracted, which is the same.
    pub fn add_literal(&mut self, left: Term, literal: f64) -> Term {
        if literal < 0.0 {
            self.push(Operation::Sub, left, Term::Literal(-literal))
        } else {
            self.push(Operation::Add, left, Term::Literal(literal))
        }
    }

    /// Σ c_k·x^k by Horner's scheme; the constant alone is a literal.
    pub fn horner(&mut self, x: Term, coefficients: &[f64]) -> Term {
        let mut coefficients = coefficients.iter().rev();
        let Some(&first) = coefficients.next() else {
            return Term::Literal(0.0);
        };
        let mut sum = Term::Literal(first);
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
        let is_mul = |step: &&Step| step.operation == Operation::Mul;
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
            mark(&mut live, value.term);
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
                term: moved(&place, value.term),
                ..value
            })
        };
        (kernel.sin, kernel.cos) = (value(self.sin), value(self.cos));
        kernel
    }

    /// Runs it bit for bit. A result that is not wanted is the angle.
    pub fn run<T: Machine>(&self, angle: T) -> (T, T) {
        let mut values: Vec<T> = Vec::with_capacity(self.steps.len());
        let read = |term: Term, values: &[T]| match term {
            Term::Angle => angle,
            Term::Literal(value) => T::literal(value),
            Term::Step(step) => values[step],
        };
        for step in &self.steps {
            let (left, right) = (read(step.left, &values), read(step.right, &values));
            values.push(left.operate(step.operation, right));
        }
        let result = |value: Option<Value>| match value {
            None => angle,
            Some(value) if value.negative => read(value.term, &values).neg(),
            Some(value) => read(value.term, &values),
        };
        (result(self.sin), result(self.cos))
    }
}
