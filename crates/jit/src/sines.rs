//! Sines by the text of `dalembert-sines`, run on values of the function that is emitted.

use std::ops::{Add, Mul, Neg, Sub};

use cranelift_codegen::ir::{InstBuilder, MemFlagsData, Value};
use dalembert_sines::text::{Angle, Number, Rounded, rest};

use crate::emit::{Call, Emitter};

#[derive(Clone, Copy)]
struct IrValue<'e, 'f>(Value, &'e Emitter<'f>);

macro_rules! operations {
    ($($operation:ident $method:ident $instruction:ident),*) => {$(
        impl $operation for IrValue<'_, '_> {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                let IrValue(value, emitter) = self;
                IrValue(emitter.with(|b| b.ins().$instruction(value, other.0)), emitter)
            }
        }
    )*};
}
operations!(Add add fadd, Sub sub fsub, Mul mul fmul);

impl Neg for IrValue<'_, '_> {
    type Output = Self;
    fn neg(self) -> Self {
        let IrValue(number, emitter) = self;
        IrValue(emitter.with(|b| b.ins().fneg(number)), emitter)
    }
}

impl<T: Into<f64>> Number<T> for IrValue<'_, '_> {
    fn all(self, value: T) -> Self {
        IrValue(self.1.constant(value.into()), self.1)
    }

    fn fused(self, factor: Self, addend: Self) -> Self {
        let IrValue(multiplicand, emitter) = self;
        let fused = emitter.with(|b| b.ins().fma(multiplicand, factor.0, addend.0));
        IrValue(fused, emitter)
    }
}

/// One question for all angles: whether a library is needed.
pub(crate) fn together<T>(emitter: &Emitter<'_>, angles: &[Value]) -> Vec<(Value, Value)>
where
    T: Angle + Into<f64>,
{
    let mut usual: Option<Value> = None;
    let mut computed = Vec::with_capacity(angles.len());
    for &angle in angles {
        let (shifted, sin, cos) = rest::<T, Rounded, _>(IrValue(angle, emitter));
        let [shifted, sin, cos] = [shifted, sin, cos].map(|traced| traced.0);
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

/// As `turned` of `dalembert-sines`, operation by operation.
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
            let component = b.ins().bxor(other, kept);
            let negative = b.ins().band(turns, sign_bit);
            let bits = b.ins().bxor(component, negative);
            b.ins().bitcast(floats, MemFlagsData::new(), bits)
        };
        (signed(cos, half_turn), signed(sin, next))
    })
}
