//! Reads emitted functions back and compares them with their program.
//!
//! - this file: what a text says, and whether it is the program
//! - `reader`: the statements, line by line, by the table of the dialect
//! - `block`: sines and cosines by polynomials
//! - `sines`: sines and cosines by calls and from a caller
//! - `wrap`: what wraps the statements of long functions
//! - `result`: the arrays and the struct at the end
//! - `entries`: functions that can be called in several ways
//! - `c99`: what C writes in its own way

mod block;
mod c99;
mod entries;
mod reader;
mod result;
mod sines;
mod wrap;

use std::fmt;

use crate::function::Function;
use crate::language::dialect::Dialect;
use crate::program::{Difference, Library, Lowered, Program, ScalarType};
use crate::sincos::{AngleKernel, lowered};
use reader::Reader;

/// A text that is not the program that it should be.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextError {
    /// The line of the text, from one.
    pub line: usize,
    /// The reason.
    pub reason: String,
}

impl fmt::Display for TextError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "emitted line {}: {}", self.line, self.reason)
    }
}

impl std::error::Error for TextError {}

impl Lowered {
    /// Reads the function of this name out of a module's text.
    ///
    /// # Errors
    /// The first line that is not of an emitted function.
    pub fn parse(
        module: &str,
        function: Function,
        scalar: ScalarType,
    ) -> Result<Lowered, TextError> {
        let lines: Vec<&str> = module.lines().map(str::trim).collect();
        let first = head(&lines, function.name())?;
        let mut reader = Reader::new(Dialect::rust(scalar));
        let (tail, end) = statements(&mut reader, &lines, first)?;
        let items = result::items(&tail, function);
        let read = items.and_then(|items| reader.finish(&items));
        read.map_err(at(end))
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
    ) -> Result<(), Difference> {
        match self.difference(&lowered(program, self.scalar, library, sines)) {
            None => Ok(()),
            Some(difference) => Err(difference),
        }
    }
}

/// Returns places a reason on a line, counted from zero.
fn at(line: usize) -> impl Fn(String) -> TextError {
    move |reason| TextError {
        line: line + 1,
        reason,
    }
}

/// Refuses a word where another one must stand.
fn expect(found: &str, expected: &str) -> Result<(), String> {
    match found == expected {
        true => Ok(()),
        false => Err(format!("`{expected}` expected, not `{found}`")),
    }
}

/// Finds the head of a function; lines are counted from zero.
fn head(lines: &[&str], name: &str) -> Result<usize, TextError> {
    let starts = |line: &&str| {
        let rest = line.strip_prefix("pub fn ");
        let rest = rest.and_then(|rest| rest.strip_prefix(name));
        rest.is_some_and(|rest| rest.starts_with(['(', '<']))
    };
    let found = lines.iter().position(starts);
    found.ok_or_else(|| at(0)(format!("there is no function `{name}`")))
}

/// Reads the statements after a head into the reader; returns what the function ends with,
/// and the line of its brace.
fn statements(
    reader: &mut Reader<'_>,
    lines: &[&str],
    head: usize,
) -> Result<(String, usize), TextError> {
    let mut tail = String::new();
    for (number, &line) in lines.iter().enumerate().skip(head + 1) {
        if tail.is_empty() && reader.line(line).map_err(at(number))? {
            continue;
        }
        if line.starts_with("let ") {
            return Err(at(number)("a statement after the result".into()));
        }
        if line == "}" && result::is_complete(&tail) {
            return Ok((tail, number));
        }
        tail.push_str(line);
        tail.push(' ');
    }
    Err(at(head)(format!("`{}` does not end", lines[head])))
}

/// Returns i of `name[i]`.
fn index_of(word: &str, name: &str) -> Option<usize> {
    word.strip_prefix(name)?
        .strip_prefix('[')?
        .strip_suffix(']')?
        .parse()
        .ok()
}
