//! Slices of different lengths.

use core::fmt;

/// The slice of a call.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Slice {
    /// The column of an argument's entry, both counted from one.
    Entry(usize, usize),
    /// An argument in rows, counted from one.
    Rows(usize),
    /// All arguments; the numbers are of entries, not of states.
    Arguments,
    /// Those in rows; the numbers are of entries, not of states.
    InRows,
    /// The column of a number of the result, counted from one.
    Result(usize),
}

/// The slices of a call are of different lengths.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Unequal {
    /// The first that differs.
    pub slice: Slice,
    /// The number of states of the slice.
    pub found: usize,
    /// The number of states of the first column of the results.
    pub expected: usize,
}

impl Unequal {
    pub(crate) fn check(slice: Slice, found: usize, expected: usize) -> Result<(), Unequal> {
        match found == expected {
            true => Ok(()),
            false => Err(Unequal {
                slice,
                found,
                expected,
            }),
        }
    }
}

impl fmt::Display for Unequal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (found, expected) = (self.found, self.expected);
        match self.slice {
            Slice::Entry(a, i) => write!(
                f,
                "entry {i} of argument {a} has {found} states, the results have {expected}"
            ),
            Slice::Rows(a) => write!(
                f,
                "argument {a} has {found} rows, and {expected} states take 1 row or {expected}"
            ),
            Slice::Arguments => write!(
                f,
                "the arguments have {found} entries, and the function takes {expected}"
            ),
            Slice::InRows => write!(
                f,
                "{found} entries come in rows, and the call is for {expected}"
            ),
            Slice::Result(k) => write!(
                f,
                "column {k} of the results has {found} states, the first has {expected}"
            ),
        }
    }
}

impl core::error::Error for Unequal {}
