//! Reads emitted functions back and compares them with their program.
//!
//! - this file: what a text says, and whether it is the program
//! - `reader`: the statements, line by line
//! - `sines`: sines and cosines as polynomials
//! - `part`: what wraps the statements of long functions
//! - `result`: the arrays and the struct at the end

mod part;
mod reader;
mod result;
mod sines;

use std::fmt;

use crate::emit::ScalarType;
use crate::emit::function::signature;
use crate::function::Function;
use crate::graph::{AngleSum, Counts, Input};
use crate::schedule::{Operand, Operation, Program};
use crate::sincos::AngleKernel;
use crate::sincos::kernel::Kernel;
use reader::Reader;

/// An emitted function as its text says.
#[derive(Clone, Debug, PartialEq)]
pub struct TextProgram {
    /// Sines and cosines.
    pub trig: Vec<TextTrig>,
    /// The arithmetic.
    pub steps: Vec<TextStep>,
    /// The results, and whether each is negated.
    pub outputs: Vec<(bool, TextOperand)>,
}

/// `let (s1, c1) = …sincos(q[0]);` or one of the two alone, or a block that
/// computes them.
#[derive(Clone, Debug, PartialEq)]
pub struct TextTrig {
    /// The angle.
    pub angle: AngleSum,
    /// Whether the sine is taken.
    pub sin: bool,
    /// Whether the cosine is taken.
    pub cos: bool,
    /// The polynomials, unless libm is called.
    pub kernel: Option<Kernel>,
}

/// `let t1 = left · right;`
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextStep {
    /// The operation.
    pub operation: Operation,
    /// Left operand.
    pub left: TextOperand,
    /// Right operand.
    pub right: TextOperand,
}

/// What a line reads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TextOperand {
    /// An input.
    Input(Input),
    /// A literal's value in the function's scalar, held exactly.
    Literal(f64),
    /// The result of an earlier line.
    Step(usize),
}

/// Why a text is not the program that it should be.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextError {
    /// One-based line of the text.
    pub line: usize,
    /// What is wrong.
    pub message: String,
}

impl fmt::Display for TextError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "emitted line {}: {}", self.line, self.message)
    }
}

impl std::error::Error for TextError {}

impl TextProgram {
    /// Reads the function of this name out of a module's text.
    pub fn parse(
        module: &str,
        function: Function,
        scalar: ScalarType,
    ) -> Result<TextProgram, TextError> {
        let head = format!("pub fn {}(", function.name());
        let lines: Vec<&str> = module.lines().map(str::trim).collect();
        let Some(first) = lines.iter().position(|line| line.starts_with(&head)) else {
            let message = format!("there is no function `{function}`");
            return Err(TextError { line: 1, message });
        };
        let read = TextProgram::read(&lines[first + 1..], function, scalar);
        read.map(|(program, _)| program).map_err(|error| TextError {
            line: error.line + first + 1,
            ..error
        })
    }

    /// Reads the lines after the signature; the program and how many they are.
    fn read(
        lines: &[&str],
        function: Function,
        scalar: ScalarType,
    ) -> Result<(TextProgram, usize), TextError> {
        let mut reader = Reader::new(scalar);
        let mut tail = String::new();
        for (number, &line) in (1..).zip(lines) {
            let at = |message| TextError {
                line: number,
                message,
            };
            if tail.is_empty() && reader.block(line).map_err(at)? {
                continue;
            }
            match line.strip_prefix("let ") {
                Some(statement) if tail.is_empty() => {
                    reader.statement(statement).map_err(at)?;
                }
                Some(_) => return Err(at("a statement after the result".into())),
                None if line == "}" && result::is_complete(&tail) => {
                    let items = result::items(&tail, function).map_err(at)?;
                    let program = reader.finish(&items).map_err(at)?;
                    return Ok((program, number));
                }
                None => {
                    tail.push_str(line);
                    tail.push(' ');
                }
            }
        }
        let message = format!("`{function}` does not end");
        Err(TextError { line: 0, message })
    }

    /// Reads a text that is this function by itself: the program's signature in
    /// this scalar, nothing but documentation above it, nothing below it.
    pub fn parse_alone(
        text: &str,
        program: &Program,
        scalar: ScalarType,
    ) -> Result<TextProgram, TextError> {
        let head = format!("{} {{", signature(program, scalar));
        let lines: Vec<&str> = text.lines().map(str::trim).collect();
        let error = |index: usize, message: String| TextError {
            line: index + 1,
            message,
        };
        let is_doc = |line: &str| line.starts_with("///") || line == "#[must_use]";
        let first = lines.iter().position(|line| !is_doc(line)).unwrap_or(0);
        match lines.get(first) {
            Some(line) if *line == head => {}
            line => {
                let line = line.copied().unwrap_or_default();
                return Err(error(first, format!("`{head}` expected, not `{line}`")));
            }
        }
        let (program, end) = TextProgram::read(&lines[first + 1..], program.function, scalar)
            .map_err(|error| TextError {
                line: error.line + first + 1,
                ..error
            })?;
        let after = first + 1 + end;
        match lines[after..].iter().position(|line| !line.is_empty()) {
            None => Ok(program),
            Some(more) => Err(error(after + more, "something after the function".into())),
        }
    }

    /// Compares with the program and libm's sines: every operation, and every
    /// literal with its exact value rounded once.
    pub fn matches(&self, program: &Program, scalar: ScalarType) -> Result<(), String> {
        self.matches_with(program, scalar, &[])
    }

    /// Compares with the program and its sines: polynomials literal by
    /// literal; angles that are not among `sines` are libm's.
    pub fn matches_with(
        &self,
        program: &Program,
        scalar: ScalarType,
        sines: &[AngleKernel],
    ) -> Result<(), String> {
        let trig = program.trig.iter().map(|t| TextTrig {
            angle: t.angle,
            sin: t.sin,
            cos: t.cos,
            kernel: sines
                .iter()
                .find(|sine| sine.angle == t.angle)
                .map(|sine| sine.kernel.clone()),
        });
        if !trig.eq(self.trig.iter().cloned()) {
            return Err("the sines and cosines differ".into());
        }
        if self.steps.len() != program.steps.len() {
            return Err("the number of operations differs".into());
        }
        for (index, (text, step)) in self.steps.iter().zip(&program.steps).enumerate() {
            let same = text.operation == step.operation
                && is(&text.left, &step.left, scalar)
                && is(&text.right, &step.right, scalar);
            if !same {
                return Err(format!("operation t{} differs", index + 1));
            }
        }
        if self.outputs.len() != program.outputs.len() {
            return Err("the number of results differs".into());
        }
        for (index, (text, output)) in self.outputs.iter().zip(&program.outputs).enumerate() {
            if text.0 != output.negative || !is(&text.1, &output.value, scalar) {
                return Err(format!("result {index} differs"));
            }
        }
        Ok(())
    }

    /// The same with libm's sines instead of polynomials: what rounding costs
    /// the rest.
    #[must_use]
    pub fn with_libm(&self) -> TextProgram {
        let mut other = self.clone();
        for trig in &mut other.trig {
            trig.kernel = None;
        }
        other
    }

    /// The operations of the text.
    pub fn counts(&self) -> Counts {
        let is_mul = |step: &&TextStep| step.operation == Operation::Mul;
        let mul = self.steps.iter().filter(is_mul).count();
        let angles: usize = self.trig.iter().map(|t| t.angle.additions()).sum();
        let kernels = self.trig.iter().filter_map(|t| t.kernel.as_ref());
        let trig = kernels.map(Kernel::counts);
        let (trig_mul, trig_add) = trig.fold((0, 0), |(m, a), (mul, add)| (m + mul, a + add));
        Counts {
            mul,
            add: self.steps.len() - mul + angles,
            div: 0,
            sincos: self.trig.len(),
            trig_mul,
            trig_add,
        }
    }
}

/// −0.0 and 0.0 differ here: the comparison is of bits.
fn is(text: &TextOperand, operand: &Operand, scalar: ScalarType) -> bool {
    match (text, operand) {
        (TextOperand::Input(a), Operand::Input(b)) => a == b,
        (TextOperand::Literal(a), Operand::Constant(b)) => a.to_bits() == scalar.round(b).to_bits(),
        (TextOperand::Step(a), Operand::Step(b)) => a == b,
        _ => false,
    }
}
