//! Reads emitted functions back and compares them with their program.
//!
//! - this file: what a text says, and whether it is the program
//! - [`error`]: why it is not
//! - `reader`: the statements, line by line
//! - `sines`: sines and cosines as polynomials
//! - `fused`: products that sums take
//! - `speed`: what is read of speeds
//! - `together`: sines and cosines that one call gives
//! - `given`: sines and cosines that a caller has
//! - `part`: what wraps the statements of long functions
//! - `result`: the arrays and the struct at the end
//! - `entries`: functions whose arithmetic stands in one of them

mod entries;
pub(crate) mod error;
mod fused;
mod given;
mod part;
mod reader;
mod result;
mod sines;
mod speed;
mod together;

use crate::function::Function;
use crate::program::{Difference, Library, Lowered, Program, ScalarType};
use crate::sincos::{AngleKernel, lowered};
pub use error::TextError;
pub(crate) use error::TextFault;
use error::{Mark, WordFault};
use reader::Reader;

impl Lowered {
    /// Reads the function of this name out of a module's text.
    pub fn parse(
        module: &str,
        function: Function,
        scalar: ScalarType,
    ) -> Result<Lowered, TextError> {
        let lines: Vec<&str> = module.lines().map(str::trim).collect();
        let first = head(&lines, function.name())?;
        let mut reader = Reader::new(scalar);
        let tail = statements(&mut reader, &lines[first + 1..], function.name());
        let read = tail.and_then(|(tail, end)| {
            let at = |fault| TextError::new(end, fault);
            let items = result::items(&tail, function).map_err(at)?;
            reader.finish(&items).map_err(at)
        });
        read.map_err(|error| error.after(first + 1))
    }

    /// Compares with the program and its sines, in the text's scalar: every
    /// operation, every literal with its exact value rounded once, polynomials
    /// literal by literal; angles that are not among `sines` are the library's.
    pub fn matches(
        &self,
        program: &Program,
        library: Library,
        sines: &[AngleKernel],
    ) -> Result<(), Difference> {
        match self.difference(&lowered(program, self.scalar, library, sines)) {
            None => Ok(()),
            Some(difference) => Err(difference),
        }
    }
}

/// The line with the head of a function, from zero.
fn head(lines: &[&str], name: &str) -> Result<usize, TextError> {
    let starts = |line: &&str| {
        let rest = line.strip_prefix("pub fn ");
        let rest = rest.and_then(|rest| rest.strip_prefix(name));
        rest.is_some_and(|rest| rest.starts_with(['(', '<']))
    };
    let found = lines.iter().position(starts);
    found.ok_or_else(|| TextError::new(1, TextFault::NoFunction(name.to_owned())))
}

/// Reads the lines after a head: the statements, into the reader, and what the
/// function ends with, with its line.
fn statements(
    reader: &mut Reader<'_>,
    lines: &[&str],
    name: &str,
) -> Result<(String, usize), TextError> {
    let mut tail = String::new();
    for (number, &line) in (1..).zip(lines) {
        let at = |fault| TextError::new(number, fault);
        if tail.is_empty() && reader.block(line).map_err(at)? {
            continue;
        }
        match line.strip_prefix("let ") {
            Some(statement) if tail.is_empty() => {
                reader.statement(statement).map_err(at)?;
            }
            Some(_) => return Err(at(TextFault::AfterResult)),
            None if line == "}" && result::is_complete(&tail) => return Ok((tail, number)),
            None => {
                tail.push_str(line);
                tail.push(' ');
            }
        }
    }
    Err(TextError::new(0, TextFault::Endless(name.to_owned())))
}

/// Name and value of a statement, without `let `.
fn binding(line: &str) -> Result<(&str, &str), WordFault> {
    let line = line.strip_suffix(';');
    let line = line.ok_or(WordFault::Lacks(Mark::Semicolon))?;
    line.split_once(" = ").ok_or(WordFault::Lacks(Mark::Equals))
}

/// Statements are numbered from one: whether this is the name behind so many.
fn is_next(name: &str, letter: &str, before: usize) -> Result<(), WordFault> {
    let expected = format!("{letter}{}", before + 1);
    if name == expected {
        return Ok(());
    }
    let found = name.to_owned();
    Err(WordFault::Next { expected, found })
}

/// i of `name[i]`.
fn index_of(word: &str, name: &str) -> Option<usize> {
    word.strip_prefix(name)?
        .strip_prefix('[')?
        .strip_suffix(']')?
        .parse()
        .ok()
}
