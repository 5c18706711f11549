//! Errors in a step, a result or an operand.

use std::fmt;

use dalembert_model::number::NotExact;

/// Why a line of a plan or of a certificate is no part of a program.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum LineFault {
    /// The words are not those of one operation.
    Step,
    /// This is the symbol of no operation.
    Operation(String),
    /// A quotient where every error must have a bound.
    Quotient,
    /// No constant stands after `#`.
    Constant(NotExact),
    /// This step is not before the one that reads it.
    Later(String),
    /// This is none of what a step may read.
    Operand(String),
    /// There are not as many results as the function has.
    Results {
        /// The expected number.
        expected: usize,
        /// The number found.
        found: usize,
    },
}

impl fmt::Display for LineFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            LineFault::Step => f.write_str("expected an operation such as `t1 + s2`"),
            LineFault::Operation(symbol) => write!(f, "`{symbol}` is no operation"),
            LineFault::Quotient => f.write_str("a quotient, of which no bound is known"),
            LineFault::Constant(error) => error.fmt(f),
            LineFault::Later(word) => write!(f, "`{word}` is not computed yet"),
            LineFault::Operand(word) => {
                write!(f, "`{word}` is neither an input, a step nor a constant")
            }
            LineFault::Results { expected, found } => {
                write!(f, "expected {expected} results, found {found}")
            }
        }
    }
}

impl std::error::Error for LineFault {}
