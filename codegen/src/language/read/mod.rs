//! Reads emitted functions back and compares them with their program.
//!
//! - this file: what a text says, and whether it is the program
//! - `reader`: the statements, line by line, by the table of the dialect
//! - `block`: sines and cosines by polynomials
//! - `sines`: sines and cosines by calls
//! - `wrap`: what wraps the statements of long functions
//! - `result`: the arrays and the struct at the end
//! - `c99`: what C writes in its own way

mod block;
mod c99;
mod reader;
mod result;
mod sines;
mod wrap;

use std::fmt;

use crate::function::Function;
use crate::language::dialect::Dialect;
use crate::language::{Printed, columns};
use crate::program::{Code, Library, Program, ScalarType};
use crate::sincos::AngleKernel;
use crate::words::Complaint;
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

impl Code {
    /// Reads the function of this name out of a module's text.
    ///
    /// # Errors
    /// The first line that is not of an emitted function.
    pub fn parse(module: &str, function: Function, scalar: ScalarType) -> Result<Code, TextError> {
        let lines: Vec<&str> = module.lines().map(str::trim).collect();
        let first = head(&lines, function.name())?;
        let mut reader = Reader::new(Dialect::rust(scalar));
        let (tail, end) = statements(&mut reader, &lines, first)?;
        let items = result::items(&tail, function);
        let read = items.and_then(|items| reader.finish(&items));
        read.map_err(at(end))
    }

    /// Reads a function out of a module's text, and compares the function of columns, if it has
    /// one, with the one that follows. Nothing is taken from the code of `printed`, which says what
    /// the function is.
    ///
    /// # Errors
    /// The first line that is not of an emitted function, or not of its columns.
    pub fn parse_rust(
        module: &str,
        printed: &Printed<'_>,
        has_columns: bool,
    ) -> Result<Code, TextError> {
        let read = Code::parse(module, printed.function, printed.code.scalar)?;
        if has_columns {
            let lines: Vec<&str> = module.lines().map(str::trim).collect();
            let code = Printed {
                code: &read,
                ..*printed
            };
            let text = columns::columns(&code);
            let own: Vec<&str> = text.lines().filter(|line| is_code(line)).collect();
            let kind = own.iter().find(|line| line.starts_with("pub struct "));
            let first = lines.iter().position(|line| Some(line) == kind);
            let missing = || at(0)(format!("there are no columns of `{}`", printed.function));
            let first = first.ok_or_else(missing)?;
            let start = text.find("pub struct ").unwrap_or_default();
            same(&lines, first, &text[start..])?;
        }
        Ok(read)
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

/// Returns `true` for a line of code, `false` for documentation.
fn is_code(line: &str) -> bool {
    !line.is_empty() && !line.starts_with("///")
}

/// Compares the lines from `first` with what they must be.
fn same(lines: &[&str], first: usize, expected: &str) -> Result<(), TextError> {
    let expected = expected.lines().map(str::trim);
    let expected = expected.filter(|line| is_code(line));
    let mut found = lines.iter().enumerate().skip(first);
    for expected in expected {
        let next = found.by_ref().find(|(_, line)| is_code(line));
        let (number, line) = next.unwrap_or((lines.len(), &""));
        expect(line, expected).map_err(at(number))?;
    }
    Ok(())
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
    reader: &mut Reader,
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

/// Returns i of `name[i]`; none of an index that no robot has.
fn index_of(word: &str, name: &str) -> Option<usize> {
    let index = word.strip_prefix(name)?.strip_prefix('[')?;
    let index: u16 = index.strip_suffix(']')?.parse().ok()?;
    Some(index.into())
}
