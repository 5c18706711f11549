//! Reads printed functions back, by the checker's reader: whether a text is the program.

use std::hash::Hash;

use dalembert_checker::identity::program::{self as straight, Operand as Read};
pub use dalembert_checker::read::TextError;
use dalembert_checker::read::{self, Head, Source, Text};

use crate::dag::Dag;
use crate::function::{Argument, Function, Sizes};
use crate::language::names::Names;
use crate::program::kernel::{Angle, Kernel, Need};
use crate::program::{
    Code, Input, Library, Literal, Operand, Operation, Output, Pair, Program, ScalarType, Speed,
    Step, Steps,
};
use crate::sincos::AngleKernel;
use crate::words::Complaint;

/// The arguments of a function, and what its results' lengths follow from.
#[derive(Clone, Copy, Debug)]
pub struct Signature<'a> {
    /// Which function.
    pub function: Function,
    /// The arguments there are, in order.
    pub arguments: &'a [Argument],
    /// The sizes that the lengths of arguments and results follow from.
    pub sizes: Sizes,
    /// The scalar.
    pub scalar: ScalarType,
}

impl<'a> Signature<'a> {
    /// Returns that of a program in a scalar.
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
            structure: self.function.structure(),
            joints: self.sizes.joints,
        }
    }
}

impl Code {
    /// Reads a function out of a module's text in Rust, and its function of columns if it has one.
    ///
    /// # Errors
    /// The first line that is not of such a function, or not of its columns.
    pub fn read_rust(
        text: &Text<'_>,
        signature: &Signature<'_>,
        has_columns: bool,
    ) -> Result<Code, TextError> {
        let (read, _) = text.rust_function(&signature.head(), has_columns)?;
        code(read, signature.scalar)
    }

    /// Reads a function out of the text of a header in C or CUDA, and its function of any number of
    /// states if it has one.
    ///
    /// # Errors
    /// The first line that is not of such a function.
    pub fn read_c(
        text: &Text<'_>,
        signature: &Signature<'_>,
        names: &Names,
        has_batch: bool,
    ) -> Result<Code, TextError> {
        let symbols = names.symbols(signature.function);
        let (read, _) = text.c_function(&signature.head(), &symbols, has_batch)?;
        code(read, signature.scalar)
    }

    /// Reads a function out of a text in Rust.
    ///
    /// # Errors
    /// As [`Code::read_rust`].
    pub fn parse(text: &str, signature: &Signature<'_>) -> Result<Code, TextError> {
        Code::read_rust(&Text::rust(text)?, signature, false)
    }

    /// Compares with the program and its sines, in the text's scalar: every
    /// operation, every literal with its exact value rounded once, polynomials
    /// literal by literal; angles that are not among `sines` are the library's.
    ///
    /// # Errors
    /// The first difference.
    pub fn matches(
        &self,
        program: &Program,
        library: Library,
        sines: &[AngleKernel],
    ) -> Result<(), Complaint> {
        match self.difference(&program.code(self.scalar, library, sines)) {
            None => Ok(()),
            Some(difference) => Err(difference),
        }
    }
}

/// Returns what was read as code.
fn code(read: read::Function, scalar: ScalarType) -> Result<Code, TextError> {
    let library = |own: &Source| match own {
        Source::Libm => Some(Library::Libm),
        Source::Together => Some(Library::Together),
        Source::Polynomial(_) => None,
    };
    let mut libraries = read.sines.iter().filter_map(|own| library(&own.source));
    let first = libraries.next().unwrap_or_default();
    if libraries.any(|other| other != first) {
        let reason = "sines of two libraries".to_owned();
        return Err(TextError { line: 1, reason });
    }
    let pairs = read.sines.into_iter().map(|own| {
        let [sin, cos] = own.needs;
        let need = Need { sin, cos };
        let kernel = match own.source {
            Source::Polynomial(program) => Some(Kernel {
                need,
                dag: graph(&program, |value| Literal(*value), |_| Angle),
            }),
            _ => None,
        };
        Pair {
            joint: own.joint,
            need,
            kernel,
        }
    });
    let speeds = read.speeds.into_iter().map(|(joint, square)| Speed {
        joint,
        square: Literal(square),
    });
    Ok(Code {
        scalar,
        library: first,
        pairs: pairs.collect(),
        speeds: speeds.collect(),
        dag: graph(&read.program, |value| Literal(*value), input),
    })
}

/// Returns an operand that is neither a constant nor a step.
pub(crate) fn input<C>(operand: &Read<C>) -> Input {
    match operand {
        Read::Entry(argument, index) => Input::Entry(Argument::ALL[*argument], *index),
        Read::Sine(angle, true) => Input::Sin(angle[0].0),
        Read::Sine(angle, false) => Input::Cos(angle[0].0),
        Read::Speed(joint) => Input::PerSpeed(*joint),
        Read::Step(_) | Read::Constant(_) => unreachable!("no input"),
    }
}

/// Returns the graph of straight-line code.
pub(crate) fn graph<V, C: Clone + Eq + Hash, I: Clone + Eq + Hash>(
    program: &straight::Program<V>,
    constant: impl Fn(&V) -> C,
    input: impl Fn(&Read<V>) -> I,
) -> Dag<C, I> {
    let operand = |own: &Read<V>| match own {
        Read::Step(step) => Operand::Step(*step),
        Read::Constant(value) => Operand::Constant(constant(value)),
        other => Operand::Input(input(other)),
    };
    let steps = program.steps.iter().map(|(operation, [left, right])| Step {
        operation: match operation {
            '+' => Operation::Add,
            '-' => Operation::Sub,
            '*' => Operation::Mul,
            '×' => Operation::Fused,
            _ => Operation::Div,
        },
        left: operand(left),
        right: operand(right),
    });
    let outputs = program.outputs.iter().map(|(negative, own)| Output {
        negative: *negative,
        value: operand(own),
    });
    let steps = Steps {
        steps: steps.collect(),
        outputs: outputs.collect(),
    };
    steps.dag()
}
