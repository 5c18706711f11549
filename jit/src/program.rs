//! The instructions of a lowered program, in its order.

use std::collections::BTreeMap;

use cranelift_codegen::ir::{InstBuilder, Value};
use dalembert_codegen::ScalarType;
use dalembert_codegen::workspace::{
    Angle, AngleSum, Argument, Input, Kernel, Library, Literal, Lowered, LoweredTrig, Operand,
    Operation, Output, Step, fusion,
};

use crate::emit::{Call, Emitter};
use crate::sines::together;

/// The program reads what it does not have: an argument, a sine or a later step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Unreadable;

/// What a program reads while its instructions are emitted.
struct Inputs<'a, 'f, R> {
    emitter: &'a Emitter<'f>,
    /// Reads an entry of an argument, the first time that it is asked for.
    read: R,
    read_before: BTreeMap<Input, Value>,
}

impl<R: FnMut(Argument, usize) -> Option<Value>> Inputs<'_, '_, R> {
    fn input(&mut self, input: Input) -> Result<Value, Unreadable> {
        if let Some(&value) = self.read_before.get(&input) {
            return Ok(value);
        }
        let Input::Entry(argument, index) = input else {
            return Err(Unreadable);
        };
        let value = (self.read)(argument, index).ok_or(Unreadable)?;
        self.read_before.insert(input, value);
        Ok(value)
    }

    /// Returns q₂ + q₃, added from the left.
    fn angle(&mut self, angle: AngleSum) -> Result<Value, Unreadable> {
        let mut sum: Option<Value> = None;
        for (joint, negative) in angle.terms() {
            let q = self.input(Input::Entry(Argument::Position, joint))?;
            sum = Some(self.emitter.with(|b| match (sum, negative) {
                (None, false) => q,
                (None, true) => b.ins().fneg(q),
                (Some(sum), false) => b.ins().fadd(sum, q),
                (Some(sum), true) => b.ins().fsub(sum, q),
            }));
        }
        Ok(sum.unwrap_or_else(|| self.emitter.constant(0.0)))
    }
}

/// Emits a program and returns its results; `read` gives entries of arguments.
pub(crate) fn emit(
    emitter: &Emitter<'_>,
    code: &Lowered,
    read: impl FnMut(Argument, usize) -> Option<Value>,
) -> Result<Vec<Value>, Unreadable> {
    let mut inputs = Inputs {
        emitter,
        read,
        read_before: BTreeMap::new(),
    };
    sines(&mut inputs, code)?;
    for speed in &code.speeds {
        let qd = inputs.input(Input::Entry(Argument::Velocity, speed.joint))?;
        let (one, square) = (emitter.constant(1.0), emitter.constant(speed.square.0));
        let value = emitter.with(|b| {
            let squared = b.ins().fmul(qd, qd);
            let sum = b.ins().fadd(squared, square);
            let root = b.ins().sqrt(sum);
            b.ins().fdiv(one, root)
        });
        inputs
            .read_before
            .insert(Input::PerSpeed(speed.joint), value);
    }
    run(emitter, &code.steps, &code.outputs, |input| {
        inputs.input(*input)
    })
}

/// Emits the sines and cosines, those of a library first.
fn sines<R>(inputs: &mut Inputs<'_, '_, R>, code: &Lowered) -> Result<(), Unreadable>
where
    R: FnMut(Argument, usize) -> Option<Value>,
{
    let emitter = inputs.emitter;
    let (own, called): (Vec<&LoweredTrig>, Vec<&LoweredTrig>) =
        code.trig.iter().partition(|trig| trig.kernel.is_some());
    let mut pairs = Vec::new();
    for trig in own {
        let angle = inputs.angle(trig.angle)?;
        if let Some(kernel) = &trig.kernel {
            pairs.push((trig.angle, polynomials(emitter, kernel, angle)?));
        }
    }
    let angles: Result<Vec<Value>, Unreadable> =
        called.iter().map(|trig| inputs.angle(trig.angle)).collect();
    let angles = angles?;
    let computed = match (code.library, code.scalar) {
        (Library::Together, ScalarType::F64) => together::<f64>(emitter, &angles),
        (Library::Together, ScalarType::F32) => together::<f32>(emitter, &angles),
        (Library::Libm, _) => {
            let all = called.iter().zip(&angles);
            let call = all.flat_map(|(trig, &angle)| {
                let kind = match (trig.sin, trig.cos) {
                    (true, false) => Call::Sine,
                    (false, true) => Call::Cosine,
                    _ => Call::Both,
                };
                emitter.call(kind, &[angle], None)
            });
            call.collect()
        }
    };
    pairs.extend(called.iter().map(|trig| trig.angle).zip(computed));
    for (angle, (sin, cos)) in pairs {
        inputs.read_before.insert(Input::Sin(angle), sin);
        inputs.read_before.insert(Input::Cos(angle), cos);
    }
    Ok(())
}

/// Returns sine and cosine by polynomials of the program's own; one that is not wanted is the
/// angle, which nobody reads.
fn polynomials(
    emitter: &Emitter<'_>,
    kernel: &Kernel,
    angle: Value,
) -> Result<(Value, Value), Unreadable> {
    let wanted: Vec<Output<Literal, Angle>> =
        [kernel.sin, kernel.cos].into_iter().flatten().collect();
    let mut values = run(emitter, &kernel.steps, &wanted, |_| Ok(angle))?.into_iter();
    let mut next = |wanted: bool| match wanted {
        true => values.next().ok_or(Unreadable),
        false => Ok(angle),
    };
    Ok((next(kernel.sin.is_some())?, next(kernel.cos.is_some())?))
}

/// Emits steps and returns the results.
fn run<I>(
    emitter: &Emitter<'_>,
    steps: &[Step<Literal, I>],
    outputs: &[Output<Literal, I>],
    mut input: impl FnMut(&I) -> Result<Value, Unreadable>,
) -> Result<Vec<Value>, Unreadable> {
    let mut values: Vec<Value> = Vec::with_capacity(steps.len());
    let mut read = |operand: &Operand<Literal, I>, values: &[Value]| match operand {
        Operand::Input(name) => input(name),
        Operand::Constant(value) => Ok(emitter.constant(value.0)),
        Operand::Step(index) => values.get(*index).copied().ok_or(Unreadable),
    };
    for (index, step) in steps.iter().enumerate() {
        let value = match fusion(steps, index) {
            None => {
                let (left, right) = (read(&step.left, &values)?, read(&step.right, &values)?);
                emitter.with(|b| match step.operation {
                    Operation::Add => b.ins().fadd(left, right),
                    Operation::Sub => b.ins().fsub(left, right),
                    Operation::Mul | Operation::Fused => b.ins().fmul(left, right),
                    Operation::Div => b.ins().fdiv(left, right),
                })
            }
            Some(fusion) => {
                let left = read(&fusion.product.left, &values)?;
                let right = read(&fusion.product.right, &values)?;
                let addend = read(fusion.addend, &values)?;
                emitter.with(|b| {
                    let left = match fusion.negative {
                        true => b.ins().fneg(left),
                        false => left,
                    };
                    let addend = match fusion.minus {
                        true => b.ins().fneg(addend),
                        false => addend,
                    };
                    b.ins().fma(left, right, addend)
                })
            }
        };
        values.push(value);
    }
    let output = |output: &Output<Literal, I>| {
        let value = read(&output.value, &values)?;
        Ok(match output.negative {
            true => emitter.with(|b| b.ins().fneg(value)),
            false => value,
        })
    };
    outputs.iter().map(output).collect()
}
