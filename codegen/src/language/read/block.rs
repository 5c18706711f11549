//! The block of an angle's polynomials, and what its lines have in common with all others.

use super::expect;
use crate::dag::{Edge, Id};
use crate::language::angles;
use crate::language::dialect::{Dialect, holes};
use crate::program::kernel::{Kernel, KernelWriter};
use crate::program::{Literal, Need, Operation, Pair};

/// The open block of an angle's polynomials.
pub(super) struct Block {
    pub(super) joint: usize,
    pub(super) need: Need,
    /// The name of the angle in its lines.
    argument: String,
    /// The name of the operations in its lines, before the number.
    prefix: String,
    writer: KernelWriter,
    /// The operations so far.
    operations: Vec<Id>,
    /// The results so far, in the order of the kernel's.
    results: Vec<Edge>,
    /// `true` once the result was read.
    done: bool,
}

impl Block {
    /// Opens the block of an angle by the names in its lines.
    pub(super) fn new(joint: usize, need: Need, argument: String, prefix: String) -> Block {
        Block {
            joint,
            need,
            argument,
            prefix,
            writer: KernelWriter::default(),
            operations: Vec::new(),
            results: Vec::new(),
            done: false,
        }
    }

    /// Returns what was read.
    pub(super) fn done(self) -> Pair {
        let kernel = Kernel {
            need: self.need,
            dag: self.writer.finish(self.results),
        };
        Pair {
            joint: self.joint,
            need: self.need,
            kernel: Some(kernel),
        }
    }

    /// Returns the block that a line opens: `let (s1, c1) = {`.
    pub(super) fn begin(line: &str) -> Option<Block> {
        let names = line.strip_prefix("let ")?.strip_suffix(" = {")?;
        let joint = joint_of(list(names)[0].strip_prefix(['s', 'c'])?)?;
        let mut needs = [(true, true), (true, false), (false, true)]
            .into_iter()
            .map(|(sin, cos)| Need { sin, cos });
        let need = needs.find(|need| names == angles::names(joint, *need))?;
        let argument = angles::operand(joint);
        Some(Block::new(joint, need, argument, "x".to_owned()))
    }

    /// Takes a line; whether it ends the block.
    pub(super) fn line(&mut self, line: &str, dialect: Dialect) -> Result<bool, String> {
        if self.done {
            expect(line, "};")?;
            return Ok(true);
        }
        match holes(dialect.declaration, line) {
            Some([name, value]) => self.step(name, value, dialect)?,
            None => {
                let words = list(line);
                if let Some(more) = words.get(self.need.count()) {
                    return Err(format!("`{more}` is of no name"));
                }
                for index in 0..self.need.count() {
                    self.result(words.get(index).unwrap_or(&""), dialect)?;
                }
                self.done = true;
            }
        }
        Ok(false)
    }

    /// Takes an operation and its name.
    pub(super) fn step(&mut self, name: &str, value: &str, dialect: Dialect) -> Result<(), String> {
        let number = self.operations.len() + 1;
        expect(name, &format!("{}{number}", self.prefix))?;
        let (operation, [left, right]) = one_operation(value, dialect)?;
        if operation == Operation::Div {
            return Err(format!("`{value}` is no operation of a polynomial"));
        }
        let operands = [self.term(left, dialect)?, self.term(right, dialect)?];
        self.operations.push(self.writer.apply(operation, operands));
        Ok(())
    }

    /// Takes a result.
    pub(super) fn result(&mut self, word: &str, dialect: Dialect) -> Result<(), String> {
        let (negative, word) = sign(word);
        let node = self.term(word, dialect)?;
        self.results.push(Edge { node, negative });
        Ok(())
    }

    fn term(&mut self, word: &str, dialect: Dialect) -> Result<Id, String> {
        if word == self.argument {
            return Ok(self.writer.angle());
        }
        if let Some(number) = word.strip_prefix(self.prefix.as_str()) {
            let number = number.parse::<usize>().ok().and_then(|n| n.checked_sub(1));
            let known = number.and_then(|number| self.operations.get(number));
            return known
                .copied()
                .ok_or_else(|| format!("`{word}` is not computed yet"));
        }
        match dialect.read_literal(word) {
            Some(Literal(value)) => Ok(self.writer.literal(value)),
            None => Err(format!(
                "`{word}` is neither the angle, a value nor a literal"
            )),
        }
    }
}

/// Reads two operands and a symbol.
pub(super) fn one_operation(
    value: &str,
    dialect: Dialect,
) -> Result<(Operation, [&str; 2]), String> {
    let read = dialect.read_operation(value);
    read.ok_or_else(|| format!("`{value}` is not one operation"))
}

/// Reads the sign of a result: a negative literal is a literal, a negated value is negated.
pub(super) fn sign(word: &str) -> (bool, &str) {
    match word.strip_prefix('-') {
        Some(rest) if !rest.starts_with(|c: char| c.is_ascii_digit()) => (true, rest),
        _ => (false, word),
    }
}

/// Returns the joint of a number in a name, which counts from one.
pub(super) fn joint_of(number: &str) -> Option<usize> {
    number.parse::<usize>().ok()?.checked_sub(1)
}

/// Returns an angle whose sines are a library's.
pub(super) fn by_library(joint: usize, need: Need) -> Pair {
    Pair {
        joint,
        need,
        kernel: None,
    }
}

/// Returns the entries of `(a, b)`, or `a`.
fn list(words: &str) -> Vec<&str> {
    let inner = words.strip_prefix('(').and_then(|w| w.strip_suffix(')'));
    inner.map_or(vec![words], |inner| inner.split(", ").collect())
}
