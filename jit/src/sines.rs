//! Sines by the text of `dalembert-sines`, run on values of the function that is emitted.

use std::ops::{Add, Mul, Neg, Sub};

use cranelift_codegen::ir::{InstBuilder, MemFlagsData, Value};
use dalembert_sines::text::{Angle, Number, Rounded, rest};

use crate::emit::{Call, Emitter};

/// A number of the text: known, or a value of the function.
#[derive(Clone, Copy)]
pub(crate) enum Traced<'e, 'f> {
    Constant(f64),
    Computed(Value, &'e Emitter<'f>),
}

#[derive(Clone, Copy)]
enum Operation {
    Add,
    Sub,
    Mul,
}

impl<'e, 'f> Traced<'e, 'f> {
    fn with(self, other: Traced<'e, 'f>, operation: Operation) -> Traced<'e, 'f> {
        let emitter = match (self, other) {
            (Traced::Computed(_, emitter), _) | (_, Traced::Computed(_, emitter)) => emitter,
            // The text computes no constant; if it did, the check at load would tell.
            (Traced::Constant(_), Traced::Constant(_)) => return Traced::Constant(f64::NAN),
        };
        let (left, right) = (self.value(emitter), other.value(emitter));
        let value = emitter.with(|b| match operation {
            Operation::Add => b.ins().fadd(left, right),
            Operation::Sub => b.ins().fsub(left, right),
            Operation::Mul => b.ins().fmul(left, right),
        });
        Traced::Computed(value, emitter)
    }

    fn value(self, emitter: &'e Emitter<'f>) -> Value {
        match self {
            Traced::Constant(value) => emitter.constant(value),
            Traced::Computed(value, _) => value,
        }
    }
}

macro_rules! operations {
    ($($operation:ident $method:ident),*) => {$(
        impl $operation for Traced<'_, '_> {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                self.with(other, Operation::$operation)
            }
        }
        impl $operation<f64> for Traced<'_, '_> {
            type Output = Self;
            fn $method(self, other: f64) -> Self {
                self.with(Traced::Constant(other), Operation::$operation)
            }
        }
        impl $operation<f32> for Traced<'_, '_> {
            type Output = Self;
            fn $method(self, other: f32) -> Self {
                self.with(Traced::Constant(f64::from(other)), Operation::$operation)
            }
        }
    )*};
}
operations!(Add add, Sub sub, Mul mul);

impl<'e, 'f> Neg for Traced<'e, 'f> {
    type Output = Self;
    fn neg(self) -> Self {
        match self {
            Traced::Constant(value) => Traced::Constant(-value),
            Traced::Computed(value, emitter) => {
                Traced::Computed(emitter.with(|b| b.ins().fneg(value)), emitter)
            }
        }
    }
}

impl<'e, 'f> Traced<'e, 'f> {
    fn fma(self, factor: Traced<'e, 'f>, addend: Traced<'e, 'f>) -> Traced<'e, 'f> {
        let emitter = match (self, factor, addend) {
            (Traced::Computed(_, emitter), ..)
            | (_, Traced::Computed(_, emitter), _)
            | (.., Traced::Computed(_, emitter)) => emitter,
            _ => return Traced::Constant(f64::NAN),
        };
        let [left, right, addend] = [self, factor, addend].map(|x| x.value(emitter));
        let value = emitter.with(|b| b.ins().fma(left, right, addend));
        Traced::Computed(value, emitter)
    }
}

impl Number<f64> for Traced<'_, '_> {
    fn all(self, value: f64) -> Self {
        Traced::Constant(value)
    }

    fn fused(self, factor: Self, addend: Self) -> Self {
        self.fma(factor, addend)
    }
}

impl Number<f32> for Traced<'_, '_> {
    fn all(self, value: f32) -> Self {
        Traced::Constant(f64::from(value))
    }

    fn fused(self, factor: Self, addend: Self) -> Self {
        self.fma(factor, addend)
    }
}

/// Sines and cosines of angles together: the polynomials, then one question for all
/// whether a library is needed.
pub(crate) fn together<'e, 'f, T>(emitter: &'e Emitter<'f>, angles: &[Value]) -> Vec<(Value, Value)>
where
    T: Angle + Into<f64>,
    Traced<'e, 'f>: Number<T>,
{
    let mut usual: Option<Value> = None;
    let mut computed = Vec::with_capacity(angles.len());
    for &angle in angles {
        let (shifted, sin, cos) = rest::<T, Rounded, _>(Traced::Computed(angle, emitter));
        let [shifted, sin, cos] = [shifted, sin, cos].map(|traced| traced.value(emitter));
        computed.push(turned(emitter, T::SIGN, shifted, sin, cos));
        let within = emitter.is_within(angle, T::LARGEST.into());
        usual = Some(match usual {
            None => within,
            Some(usual) => emitter.with(|b| b.ins().band(usual, within)),
        });
    }
    match usual {
        None => computed,
        Some(usual) => emitter.call(Call::Unusual, angles, Some((usual, &computed))),
    }
}

/// Turns by how many quarter turns there are: as `turned` of `dalembert-sines`, operation by
/// operation.
fn turned(
    emitter: &Emitter<'_>,
    sign: usize,
    shifted: Value,
    sin: Value,
    cos: Value,
) -> (Value, Value) {
    let (integers, one) = (emitter.integers(), emitter.power(0));
    let (below, sign_bit) = (emitter.power(sign - 1), emitter.power(sign));
    emitter.with(|b| {
        let floats = b.func.dfg.value_type(sin);
        let [count, sin, cos] =
            [shifted, sin, cos].map(|x| b.ins().bitcast(integers, MemFlagsData::new(), x));
        let differ = b.ins().bxor(sin, cos);
        let odd = b.ins().band(count, one);
        let even = b.ins().isub(odd, one);
        let kept = b.ins().band(differ, even);
        let half_turn = b.ins().ishl_imm_u(count, (sign - 1) as i64);
        let next = b.ins().iadd(half_turn, below);
        let mut signed = |other: Value, turns: Value| {
            let own = b.ins().bxor(other, kept);
            let negative = b.ins().band(turns, sign_bit);
            let bits = b.ins().bxor(own, negative);
            b.ins().bitcast(floats, MemFlagsData::new(), bits)
        };
        (signed(cos, half_turn), signed(sin, next))
    })
}
