//! The operations of `dalembert-sines`, recorded from that crate's own text.

use std::cell::RefCell;
use std::ops::{Add, Mul, Neg, Sub};

use dalembert_sines::text::{Number, Rounded, rest};

use crate::dag::{Edge, Id};
use crate::program::kernel::{Kernel, KernelWriter, Need};
use crate::program::{Operation, ScalarType};

/// A number that records the operations on it.
#[derive(Clone, Copy)]
struct Recorded<'t> {
    /// The operations so far; none for a literal.
    tape: Option<&'t RefCell<KernelWriter>>,
    value: Value,
}

#[derive(Clone, Copy)]
enum Value {
    Node(Id),
    Literal(f64),
}

/// Records the operations by which sine and cosine follow from an angle, before both trade
/// places or change their signs.
pub(crate) fn routine(scalar: ScalarType) -> Kernel {
    let tape = RefCell::new(KernelWriter::default());
    let angle = tape.borrow_mut().angle();
    let angle = Recorded {
        tape: Some(&tape),
        value: Value::Node(angle),
    };
    let (_, sin, cos) = match scalar {
        ScalarType::F64 => rest::<f64, Rounded, _>(angle),
        ScalarType::F32 => rest::<f32, Rounded, _>(angle),
    };
    let results = [sin, cos].map(|result| Edge::from(result.node(&mut tape.borrow_mut())));
    let need = Need {
        sin: true,
        cos: true,
    };
    tape.take().kernel(need, results)
}

impl<'t> Recorded<'t> {
    fn literal(value: f64) -> Recorded<'t> {
        Recorded {
            tape: None,
            value: Value::Literal(value),
        }
    }

    fn node(self, tape: &mut KernelWriter) -> Id {
        match self.value {
            Value::Node(id) => id,
            Value::Literal(value) => tape.literal(value),
        }
    }

    fn record(self, operation: Operation, other: Recorded<'t>) -> Recorded<'t> {
        let Some(tape) = self.tape.or(other.tape) else {
            // The routine has no operation of two literals.
            return Recorded::literal(f64::NAN);
        };
        let mut writer = tape.borrow_mut();
        let operands = [self, other].map(|operand| operand.node(&mut writer));
        Recorded {
            tape: Some(tape),
            value: Value::Node(writer.apply(operation, operands)),
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
