//! Reasons why something is not shown.

use std::fmt;

/// A reason why something is not shown: it could not be read, is of a kind that this
/// checker does not know, or takes more work than it is willing to do.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Fault {
    /// The robot file: the key at fault, and what was expected.
    Robot(String, String),
    /// The claim: what is wrong with it, or with what it says.
    Claim(String),
    /// The text of the function: its line, from one, and what was expected there.
    Text(usize, String),
    /// A polynomial has a higher power of a variable than is written down, or more terms.
    Large,
    /// More work than is done for one function.
    Work,
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Fault::Robot(key, why) => write!(f, "robot file, `{key}`: {why}"),
            Fault::Claim(why) => write!(f, "claim: {why}"),
            Fault::Text(line, why) => write!(f, "text, line {line}: {why}"),
            Fault::Large => f.write_str(
                "this is too general to be written out: a power beyond c^7, q\u{307}^3 and q\u{308}^1, \
                 or more than 262144 terms",
            ),
            Fault::Work => f.write_str("this takes more work than is allowed for one file"),
        }
    }
}

impl std::error::Error for Fault {}
