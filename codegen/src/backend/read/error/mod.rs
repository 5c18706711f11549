//! Why a text is not the program that it should be.
//!
//! - this file: [`TextError`]: the line and its fault; what no line says
//! - `word`: a word that is not what it should be
//! - `sines`: sines and cosines that are not those of their angles
//! - `speed`: what is read of speeds
//! - `entries`: functions that can be called in several ways

mod entries;
mod sines;
mod speed;
mod word;

use std::fmt;

pub(crate) use entries::EntryFault;
pub(crate) use sines::SineFault;
pub(crate) use speed::SpeedFault;
pub(crate) use word::{Kind, Mark, WordFault};

/// Why a text is not the program that it should be.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextError {
    /// One-based line of the text.
    pub line: usize,
    /// What is wrong.
    pub fault: TextFault,
}

impl fmt::Display for TextError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "emitted line {}: {}", self.line, self.fault)
    }
}

impl std::error::Error for TextError {}

impl TextError {
    /// A fault on a line.
    pub(super) fn new(line: usize, fault: impl Into<TextFault>) -> TextError {
        let fault = fault.into();
        TextError { line, fault }
    }

    /// The same in a text of which so many lines come before.
    pub(super) fn after(self, lines: usize) -> TextError {
        TextError {
            line: self.line + lines,
            ..self
        }
    }
}

/// What is wrong with a line of emitted code, or with the function around it.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum TextFault {
    /// There is no function of this name.
    NoFunction(String),
    /// The function of this name does not end.
    Endless(String),
    /// A word is not what it should be.
    Word(WordFault),
    /// Sines and cosines are not those of their angles.
    Sines(SineFault),
    /// What is read of a speed is not that.
    Speed(SpeedFault),
    /// An entry does not bring every value where it belongs.
    Entry(EntryFault),
    /// A block within a block.
    Nested,
    /// A block ends with the function, or not at all.
    OpenBlock,
    /// A block goes on after what it hands on.
    Overlong,
    /// A block hands on other names than it is bound to.
    HandedOn {
        /// The names that it hands on.
        inside: String,
        /// The names that it is bound to.
        outside: String,
    },
    /// A statement after the result.
    AfterResult,
    /// A word after the result.
    Trailing(String),
    /// The rows of a result differ in length.
    Ragged,
    /// An array of the result has another length than it must have.
    Length {
        /// What it must have.
        expected: usize,
        /// What it has.
        found: usize,
    },
}

impl fmt::Display for TextFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            TextFault::NoFunction(name) => write!(f, "there is no function `{name}`"),
            TextFault::Endless(name) => write!(f, "`{name}` does not end"),
            TextFault::Word(fault) => fault.fmt(f),
            TextFault::Sines(fault) => fault.fmt(f),
            TextFault::Speed(fault) => fault.fmt(f),
            TextFault::Entry(fault) => fault.fmt(f),
            TextFault::Nested => f.write_str("a block in a block"),
            TextFault::OpenBlock => f.write_str("a block does not end"),
            TextFault::Overlong => f.write_str("the block does not end"),
            TextFault::HandedOn { inside, outside } => {
                write!(f, "the block hands on {inside} as {outside}")
            }
            TextFault::AfterResult => f.write_str("a statement after the result"),
            TextFault::Trailing(word) => write!(f, "`{word}` after the result"),
            TextFault::Ragged => f.write_str("rows of different lengths"),
            TextFault::Length { expected, found } => write!(
                f,
                "an array of {expected} expected in the result, not of {found}"
            ),
        }
    }
}

impl std::error::Error for TextFault {}

impl From<WordFault> for TextFault {
    fn from(fault: WordFault) -> TextFault {
        TextFault::Word(fault)
    }
}

impl From<SineFault> for TextFault {
    fn from(fault: SineFault) -> TextFault {
        TextFault::Sines(fault)
    }
}

impl From<SpeedFault> for TextFault {
    fn from(fault: SpeedFault) -> TextFault {
        TextFault::Speed(fault)
    }
}

impl From<EntryFault> for TextFault {
    fn from(fault: EntryFault) -> TextFault {
        TextFault::Entry(fault)
    }
}
