//! The instructions of a program, in its order.

use std::collections::BTreeMap;

use cranelift_codegen::ir::{InstBuilder, Value};
use dalembert_codegen::ScalarType;
use dalembert_codegen::workspace::{
    Argument, Code, Dag, Input, Kernel, Library, Literal, Node, Operation, Pair,
};

use crate::emit::{Call, Emitter};
use crate::error::Error;
use crate::sines::together;

struct Inputs<'a, 'f, R> {
    emitter: &'a Emitter<'f>,
    read: R,
    read_before: BTreeMap<Input, Value>,
}

impl<R: FnMut(Argument, usize) -> Option<Value>> Inputs<'_, '_, R> {
    fn input(&mut self, input: Input) -> Result<Value, Error> {
        if let Some(&value) = self.read_before.get(&input) {
            return Ok(value);
        }
        let Input::Entry(argument, index) = input else {
            return Err(Error::Program);
        };
        let value = (self.read)(argument, index).ok_or(Error::Program)?;
        self.read_before.insert(input, value);
        Ok(value)
    }

    fn angle(&mut self, joint: usize) -> Result<Value, Error> {
        self.input(Input::Entry(Argument::Position, joint))
    }

    fn sines(&mut self, code: &Code) -> Result<(), Error> {
        let emitter = self.emitter;
        let (inline, called): (Vec<&Pair>, Vec<&Pair>) =
            code.pairs.iter().partition(|pair| pair.kernel.is_some());
        let mut pairs = Vec::new();
        for pair in inline {
            let angle = self.angle(pair.joint)?;
            if let Some(kernel) = &pair.kernel {
                pairs.push((pair.joint, polynomials(emitter, kernel, angle)?));
            }
        }
        let mut angles = Vec::new();
        for pair in &called {
            angles.push(self.angle(pair.joint)?);
        }
        let computed = match (code.library, code.scalar) {
            (Library::Together, ScalarType::F64) => together::<f64>(emitter, &angles),
            (Library::Together, ScalarType::F32) => together::<f32>(emitter, &angles),
            (Library::Libm, _) => {
                let calls = called.iter().zip(&angles);
                let call = calls.flat_map(|(pair, &angle)| {
                    let kind = match (pair.need.sin, pair.need.cos) {
                        (true, false) => Call::Sine,
                        (false, true) => Call::Cosine,
                        _ => Call::Both,
                    };
                    emitter.call(kind, &[angle], None)
                });
                call.collect()
            }
        };
        pairs.extend(called.iter().map(|pair| pair.joint).zip(computed));
        for (joint, (sin, cos)) in pairs {
            self.read_before.insert(Input::Sin(joint), sin);
            self.read_before.insert(Input::Cos(joint), cos);
        }
        Ok(())
    }
}

pub(crate) fn emit(
    emitter: &Emitter<'_>,
    code: &Code,
    read: impl FnMut(Argument, usize) -> Option<Value>,
) -> Result<Vec<Value>, Error> {
    let mut inputs = Inputs {
        emitter,
        read,
        read_before: BTreeMap::new(),
    };
    inputs.sines(code)?;
    for speed in &code.speeds {
        let qd = inputs.input(Input::Entry(Argument::Velocity, speed.coordinate))?;
        let (one, square) = (emitter.constant(1.0), emitter.constant(speed.square.0));
        let value = emitter.with(|b| {
            let squared = b.ins().fmul(qd, qd);
            let sum = b.ins().fadd(squared, square);
            let root = b.ins().sqrt(sum);
            b.ins().fdiv(one, root)
        });
        let name = Input::PerSpeed(speed.coordinate);
        inputs.read_before.insert(name, value);
    }
    run(emitter, &code.dag, |input| inputs.input(*input))
}

/// In place of a sine or cosine that is not wanted stands the angle, which is never read.
fn polynomials(
    emitter: &Emitter<'_>,
    kernel: &Kernel,
    angle: Value,
) -> Result<(Value, Value), Error> {
    let values = run(emitter, &kernel.dag, |_| Ok(angle))?;
    let [sin, cos] = kernel.need.each(values);
    Ok((sin.unwrap_or(angle), cos.unwrap_or(angle)))
}

fn run<I>(
    emitter: &Emitter<'_>,
    dag: &Dag<Literal, I>,
    mut input: impl FnMut(&I) -> Result<Value, Error>,
) -> Result<Vec<Value>, Error> {
    let signed = |value: Value, is_negative: bool| match is_negative {
        true => emitter.with(|b| b.ins().fneg(value)),
        false => value,
    };
    let mut values: Vec<Value> = Vec::with_capacity(dag.nodes.len());
    for (node, id) in dag.nodes.iter().zip(0..) {
        let value = match node {
            Node::Input(name) => input(name)?,
            Node::Constant(value) => emitter.constant(value.0),
            Node::Apply(operation, operands) => match dag.fusion(id) {
                None => {
                    let [left, right] = operands.map(|id| values[id as usize]);
                    emitter.with(|b| match operation {
                        Operation::Add => b.ins().fadd(left, right),
                        Operation::Sub => b.ins().fsub(left, right),
                        Operation::Mul | Operation::Fused => b.ins().fmul(left, right),
                        Operation::Div => b.ins().fdiv(left, right),
                    })
                }
                Some(fusion) => {
                    let [left, right] = fusion.factors.map(|id| values[id as usize]);
                    let left = signed(left, fusion.negative);
                    let addend = signed(values[fusion.addend as usize], fusion.minus);
                    emitter.with(|b| b.ins().fma(left, right, addend))
                }
            },
        };
        values.push(value);
    }
    let outputs = dag.outputs.iter();
    let values = outputs.map(|output| signed(values[output.index()], output.negative));
    Ok(values.collect())
}
