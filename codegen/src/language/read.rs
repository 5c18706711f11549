//! Reads printed functions back, by the checker's reader: whether a text is the program.

use std::hash::Hash;

use dalembert_checker::Fault;
use dalembert_checker::program::{self as straight, Operand as Read};
use dalembert_checker::read::{self, Head, Source, Text};

use crate::dag::Dag;
use crate::function::{Argument, Function, Sizes};
use crate::language::Language;
use crate::language::names::Names;
use crate::program::kernel::{Angle, Kernel, SinCosUse};
use crate::program::{
    Code, Input, Library, Literal, Operand, Operation, Output, Pair, Program, ScalarType, Speed,
    Step, Steps,
};

/// The arguments of a function, and what its results' lengths follow from.
#[derive(Clone, Copy, Debug)]
pub struct Signature<'a> {
    pub function: Function,
    pub arguments: &'a [Argument],
    pub sizes: Sizes,
    pub scalar: ScalarType,
}

impl<'a> Signature<'a> {
    pub fn of(program: &'a Program, scalar: ScalarType) -> Signature<'a> {
        Signature {
            function: program.function,
            arguments: &program.arguments,
            sizes: program.sizes(),
            scalar,
        }
    }

    fn head(&self) -> Head<'static> {
        let arguments = self.arguments.iter().map(|argument| read::Argument {
            place: argument.index(),
            name: argument.name(),
            length: argument.length(self.sizes),
        });
        let fields = self.function.quantities().iter().map(|quantity| {
            let lengths = quantity.shape().lengths(self.sizes);
            (quantity.field(), lengths.collect())
        });
        Head {
            name: self.function.name(),
            is_single: self.scalar == ScalarType::F32,
            arguments: arguments.collect(),
            fields: fields.collect(),
            joints: self.sizes.joints,
        }
    }
}

impl Code {
    /// Reads a function out of a module's text, with its function of many states if it has one. Fails
    /// with the first line that is not of such a function.
    pub fn read(
        text: &Text<'_>,
        signature: &Signature<'_>,
        names: &Names,
        has_many: bool,
    ) -> Result<Code, Fault> {
        let is_c = names.language != Language::Rust;
        let symbols = is_c.then(|| names.symbols(signature.function));
        let (read, _) = text.function(&signature.head(), symbols.as_ref(), has_many)?;
        code(read, signature.scalar)
    }

    /// Reads a function out of a text in Rust, as [`Code::read`] does.
    pub fn parse(text: &str, signature: &Signature<'_>) -> Result<Code, Fault> {
        let names = Names::new("", Language::Rust, signature.scalar);
        Code::read(&Text::rust(text)?, signature, &names, false)
    }
}

fn code(read: read::ReadFunction, scalar: ScalarType) -> Result<Code, Fault> {
    let mut libraries = read.sines.iter().filter_map(|sine| match sine.source {
        Source::Libm => Some(Library::Libm),
        Source::Together => Some(Library::Together),
        Source::Polynomial(_) => None,
    });
    let first = libraries.next().unwrap_or_default();
    if libraries.any(|other| other != first) {
        return Err(Fault::Text(1, "sines of two libraries".to_owned()));
    }
    let pairs = read.sines.into_iter().map(|sine| {
        let [sin, cos] = sine.needs;
        let need = SinCosUse { sin, cos };
        let kernel = match sine.source {
            Source::Polynomial(program) => Some(Kernel {
                need,
                dag: graph(&program, |value| Literal(*value), |_| Angle),
            }),
            _ => None,
        };
        Pair {
            joint: sine.joint,
            need,
            kernel,
        }
    });
    let speeds = read.speeds.into_iter().map(|(coordinate, square)| Speed {
        coordinate,
        square: Literal(square),
    });
    Ok(Code {
        scalar,
        library: first,
        pairs: pairs.collect(),
        speeds: speeds.collect(),
        dag: graph(&read.program, |value| Literal(*value), input),
        loops: Vec::new(),
    })
}

pub(crate) fn input<C>(operand: &Read<C>) -> Input {
    match operand {
        Read::Entry(argument, index) => Input::Entry(Argument::ALL[*argument], *index),
        Read::Sine(joint, true) => Input::Sin(*joint),
        Read::Sine(joint, false) => Input::Cos(*joint),
        Read::Speed(coordinate) => Input::PerSpeed(*coordinate),
        Read::Step(_) | Read::Constant(_) => unreachable!("no input"),
    }
}

pub(crate) fn graph<V, C: Clone + Eq + Hash, I: Clone + Eq + Hash>(
    program: &straight::Program<V>,
    constant: impl Fn(&V) -> C,
    input: impl Fn(&Read<V>) -> I,
) -> Dag<C, I> {
    let operand = |operand: &Read<V>| match operand {
        Read::Step(step) => Operand::Step(*step),
        Read::Constant(value) => Operand::Constant(constant(value)),
        other => Operand::Input(input(other)),
    };
    let steps = program.steps.iter().map(|(operation, [left, right])| Step {
        operation: Operation::from_symbol(*operation).unwrap_or(Operation::Div),
        left: operand(left),
        right: operand(right),
    });
    let outputs = program.outputs.iter().map(|(negative, result)| Output {
        negative: *negative,
        value: operand(result),
    });
    let (steps, outputs) = (steps.collect(), outputs.collect());
    Steps { steps, outputs }.dag()
}
