//! Functions that can be called in several ways, and do not bring every value
//! where it belongs.

use std::fmt;

/// Why an entry is not the function that it stands for.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum EntryFault {
    /// The function of this name reads other sines than it computes.
    OtherAngles(String),
    /// The sines of lanes are not those of one state.
    OtherSines,
    /// A line that must make room for the results does not.
    NoResults(String),
    /// A line that must give a lane a result does not.
    NoLane(String),
    /// A number of the result is given twice.
    Twice,
    /// Not every number of the result is given; there are so many.
    Count(usize),
    /// Other arrays are filled than there are.
    OtherArrays,
    /// A line does not call what runs a batch, with the function's own type.
    Driver {
        /// What runs it.
        driver: &'static str,
        /// The line.
        line: String,
    },
    /// The type that a batch is run with lacks a part.
    Lacks {
        /// The type.
        kind: String,
        /// What it lacks.
        part: &'static str,
    },
    /// The result has not the numbers of this arm's.
    OtherArm,
}

impl fmt::Display for EntryFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            EntryFault::OtherAngles(name) => {
                write!(f, "`{name}` does not compute the sines that it reads")
            }
            EntryFault::OtherSines => f.write_str("the sines are not those of one state"),
            EntryFault::NoResults(line) => write!(f, "the results expected, not `{line}`"),
            EntryFault::NoLane(line) => write!(f, "`{line}` gives a lane no result"),
            EntryFault::Twice => f.write_str("a number of the result twice"),
            EntryFault::Count(count) => write!(f, "{count} numbers of the result expected"),
            EntryFault::OtherArrays => f.write_str("other arrays are filled than there are"),
            EntryFault::Driver { driver, line } => write!(
                f,
                "`{driver}` of the function's own type expected, not `{line}`"
            ),
            EntryFault::Lacks { kind, part } => write!(f, "`{kind}` has no {part}"),
            EntryFault::OtherArm => f.write_str("a result of another arm"),
        }
    }
}

impl std::error::Error for EntryFault {}
