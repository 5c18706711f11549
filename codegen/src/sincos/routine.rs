//! The operations of `dalembert-sines`, recorded from that crate's own text.

use std::cell::RefCell;
use std::ops::{Add, Mul, Neg, Sub};

use dalembert_sines::text::{Number, Rounded, rest};

use crate::program::kernel::{ANGLE, Kernel, KernelStep, Term, Value, literal};
use crate::program::{Operation, ScalarType};

/// A number that records the operations on it.
#[derive(Clone, Copy)]
struct Recorded<'t> {
    /// The operations so far; none for a literal.
    tape: Option<&'t RefCell<Vec<KernelStep>>>,
    term: Term,
}

/// Records the operations by which sine and cosine follow from an angle, before both trade
/// places or change their signs.
pub(crate) fn routine(scalar: ScalarType) -> Kernel {
    let tape = RefCell::new(Vec::new());
    let angle = Recorded {
        tape: Some(&tape),
        term: ANGLE,
    };
    let (_, sin, cos) = match scalar {
        ScalarType::F64 => rest::<f64, Rounded, _>(angle),
        ScalarType::F32 => rest::<f32, Rounded, _>(angle),
    };
    let (sin, cos) = (Value::of(sin.term), Value::of(cos.term));
    Kernel {
        steps: tape.take(),
        sin: Some(sin),
        cos: Some(cos),
    }
}

impl<'t> Recorded<'t> {
    fn literal(value: f64) -> Recorded<'t> {
        Recorded {
            tape: None,
            term: literal(value),
        }
    }

    fn record(self, operation: Operation, other: Recorded<'t>) -> Recorded<'t> {
        let Some(tape) = self.tape.or(other.tape) else {
            // The routine has no operation of two literals.
            return Recorded::literal(f64::NAN);
        };
        let mut steps = tape.borrow_mut();
        steps.push(KernelStep {
            operation,
            left: self.term,
            right: other.term,
        });
        Recorded {
            tape: Some(tape),
            term: Term::Step(steps.len() - 1),
        }
    }
}

/// The routine of rounded products negates nothing.
impl Neg for Recorded<'_> {
    type Output = Self;
    fn neg(self) -> Self {
        Recorded::literal(f64::NAN)
    }
}

macro_rules! operation {
    ($operation:ident, $method:ident) => {
        impl<'t> $operation for Recorded<'t> {
            type Output = Recorded<'t>;
            fn $method(self, other: Recorded<'t>) -> Recorded<'t> {
                self.record(Operation::$operation, other)
            }
        }

        impl<'t> $operation<f64> for Recorded<'t> {
            type Output = Recorded<'t>;
            fn $method(self, other: f64) -> Recorded<'t> {
                self.record(Operation::$operation, Recorded::literal(other))
            }
        }

        impl<'t> $operation<f32> for Recorded<'t> {
            type Output = Recorded<'t>;
            fn $method(self, other: f32) -> Recorded<'t> {
                self.record(Operation::$operation, Recorded::literal(other.into()))
            }
        }
    };
}
operation!(Add, add);
operation!(Sub, sub);
operation!(Mul, mul);

impl Number<f64> for Recorded<'_> {
    fn all(self, value: f64) -> Self {
        Recorded::literal(value)
    }

    fn fused(self, factor: Self, addend: Self) -> Self {
        self * factor + addend
    }
}

impl Number<f32> for Recorded<'_> {
    fn all(self, value: f32) -> Self {
        Recorded::literal(value.into())
    }

    fn fused(self, factor: Self, addend: Self) -> Self {
        self * factor + addend
    }
}
