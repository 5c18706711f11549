//! The routine as it stands, recorded.

use std::cell::RefCell;
use std::ops::{Add, Mul, Neg, Sub};

use dalembert_sines::text::{Number, Products, rest};

use crate::program::kernel::{ANGLE, Kernel, KernelStep, Term, Value, literal};
use crate::program::{Operation, ScalarType};

/// A number that notes what is done with it.
#[derive(Clone, Copy)]
struct Traced<'t> {
    /// None of a literal.
    tape: Option<&'t RefCell<Vec<KernelStep>>>,
    term: Term,
    /// Is true where a fused product takes the opposite of this value.
    negative: bool,
}

/// Returns what sine and cosine are computed by from an angle, before they trade places or
/// change their signs.
pub(crate) fn trace<P: Products<f64> + Products<f32>>(scalar: ScalarType) -> Kernel {
    let tape = RefCell::new(Vec::new());
    let angle = Traced {
        tape: Some(&tape),
        term: ANGLE,
        negative: false,
    };
    let (_, sin, cos) = match scalar {
        ScalarType::F64 => rest::<f64, P, _>(angle),
        ScalarType::F32 => rest::<f32, P, _>(angle),
    };
    let (sin, cos) = (Value::of(sin.term), Value::of(cos.term));
    Kernel {
        steps: tape.take(),
        sin: Some(sin),
        cos: Some(cos),
    }
}

impl<'t> Traced<'t> {
    fn literal(value: f64) -> Traced<'t> {
        Traced {
            tape: None,
            term: literal(value),
            negative: false,
        }
    }

    fn record(self, operation: Operation, other: Traced<'t>) -> Traced<'t> {
        let Some(tape) = self.tape.or(other.tape) else {
            // Literals alone are no part of the routine: nothing is proved of them.
            return Traced::literal(f64::NAN);
        };
        let mut steps = tape.borrow_mut();
        steps.push(KernelStep {
            operation,
            left: self.term,
            right: other.term,
        });
        Traced {
            tape: Some(tape),
            term: Term::Step(steps.len() - 1),
            negative: false,
        }
    }

    fn fuse(self, factor: Traced<'t>, addend: Traced<'t>) -> Traced<'t> {
        let product = self.record(Operation::Fused, factor);
        match (self.negative != factor.negative, addend.negative) {
            (false, false) => product.record(Operation::Add, addend),
            (false, true) => product.record(Operation::Sub, addend),
            (true, false) => addend.record(Operation::Sub, product),
            // Of none of both a step says so.
            (true, true) => Traced::literal(f64::NAN),
        }
    }
}

impl Neg for Traced<'_> {
    type Output = Self;
    fn neg(self) -> Self {
        Traced {
            negative: !self.negative,
            ..self
        }
    }
}

macro_rules! operation {
    ($operation:ident, $method:ident) => {
        impl<'t> $operation for Traced<'t> {
            type Output = Traced<'t>;
            fn $method(self, other: Traced<'t>) -> Traced<'t> {
                self.record(Operation::$operation, other)
            }
        }

        impl<'t> $operation<f64> for Traced<'t> {
            type Output = Traced<'t>;
            fn $method(self, other: f64) -> Traced<'t> {
                self.record(Operation::$operation, Traced::literal(other))
            }
        }

        impl<'t> $operation<f32> for Traced<'t> {
            type Output = Traced<'t>;
            fn $method(self, other: f32) -> Traced<'t> {
                self.record(Operation::$operation, Traced::literal(other.into()))
            }
        }
    };
}
operation!(Add, add);
operation!(Sub, sub);
operation!(Mul, mul);

impl Number<f64> for Traced<'_> {
    fn all(self, value: f64) -> Self {
        Traced::literal(value)
    }

    fn fused(self, factor: Self, addend: Self) -> Self {
        self.fuse(factor, addend)
    }
}

impl Number<f32> for Traced<'_> {
    fn all(self, value: f32) -> Self {
        Traced::literal(value.into())
    }

    fn fused(self, factor: Self, addend: Self) -> Self {
        self.fuse(factor, addend)
    }
}
