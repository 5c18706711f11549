//! The operations of `dalembert-sines`, recorded from that crate's own text.

use std::cell::RefCell;
use std::ops::{Add, Mul, Neg, Sub};

use dalembert_sines::text::{Number, Rounded, rest};

use crate::dag::{Edge, Id};
use crate::program::kernel::{Kernel, KernelWriter, SinCosUse};
use crate::program::{Operation, ScalarType};

#[derive(Clone, Copy)]
struct TapeValue<'t> {
    tape: &'t RefCell<KernelWriter>,
    id: Id,
}

/// Records the operations from an angle to both sines, before they trade places or change signs.
pub(crate) fn routine(scalar: ScalarType) -> Kernel {
    let tape = RefCell::new(KernelWriter::default());
    let id = tape.borrow_mut().angle();
    let angle = TapeValue { tape: &tape, id };
    let (_, sin, cos) = match scalar {
        ScalarType::F64 => rest::<f64, Rounded, _>(angle),
        ScalarType::F32 => rest::<f32, Rounded, _>(angle),
    };
    let results = [sin, cos].map(|result| Edge::from(result.id));
    tape.take().kernel(SinCosUse::BOTH, results)
}

/// The routine of rounded products negates nothing.
impl Neg for TapeValue<'_> {
    type Output = Self;
    fn neg(self) -> Self {
        self.all(f64::NAN)
    }
}

macro_rules! operation {
    ($operation:ident, $method:ident) => {
        impl $operation for TapeValue<'_> {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                let mut tape = self.tape.borrow_mut();
                let id = tape.apply(Operation::$operation, [self.id, other.id]);
                TapeValue { id, ..self }
            }
        }
    };
}
operation!(Add, add);
operation!(Sub, sub);
operation!(Mul, mul);

impl<T: Into<f64>> Number<T> for TapeValue<'_> {
    fn all(self, value: T) -> Self {
        let id = self.tape.borrow_mut().literal(value.into());
        TapeValue { id, ..self }
    }

    fn fused(self, factor: Self, addend: Self) -> Self {
        self * factor + addend
    }
}
