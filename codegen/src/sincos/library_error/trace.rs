//! The routine as it stands, recorded.

use std::cell::RefCell;
use std::ops::{Add, Mul, Sub};

use dalembert_sines::text::{Number, rest};

use crate::program::kernel::{ANGLE, Kernel, KernelStep, Term, Value, literal};
use crate::program::{Operation, ScalarType};

/// A number that notes what is done with it.
#[derive(Clone, Copy)]
struct Traced<'t> {
    /// None of a literal.
    tape: Option<&'t RefCell<Vec<KernelStep>>>,
    term: Term,
}

/// Returns what sine and cosine are computed by from an angle, before they trade places or
/// change their signs.
pub(crate) fn trace(scalar: ScalarType) -> Kernel {
    let tape = RefCell::new(Vec::new());
    let angle = Traced {
        tape: Some(&tape),
        term: ANGLE,
    };
    let (_, sin, cos) = match scalar {
        ScalarType::F64 => rest::<f64, _>(angle),
        ScalarType::F32 => rest::<f32, _>(angle),
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
}

impl Number<f32> for Traced<'_> {
    fn all(self, value: f32) -> Self {
        Traced::literal(value.into())
    }
}
