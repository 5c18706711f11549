//! Sines and cosines that are not those of their angles.

use std::fmt;

use crate::program::AngleSum;

/// Why lines do not give the sines and cosines of their angles.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum SineFault {
    /// A sum of angles has the name of another one.
    Misnamed {
        /// The name, without its first letter.
        name: String,
        /// What it is.
        sum: AngleSum,
    },
    /// A sum has a joint twice.
    JointTwice,
    /// No line reads a sum.
    Unread(AngleSum),
    /// The block of an angle's polynomials does not end.
    OpenBlock,
    /// A call after the one for all angles.
    AfterAll,
    /// A call for all angles has not as many sines, cosines and angles.
    Uneven,
    /// A call for all angles takes nothing of this one.
    Untaken(String),
    /// A call for all angles leaves out a sum.
    Uncalled(AngleSum),
    /// A sine or cosine has not the name of its angle.
    Name {
        /// The name that it must have, unless nobody takes it.
        expected: String,
        /// The name that it has.
        found: String,
    },
    /// A line has not as many names as the caller's sines and cosines.
    UnevenNames,
    /// A name is not that of what the caller gives.
    GivenName {
        /// The name.
        name: String,
        /// What it names.
        value: String,
    },
    /// What the caller gives stands elsewhere.
    GivenPlace {
        /// The name.
        name: String,
        /// Where it is taken from.
        value: String,
    },
    /// A line has the sines or cosines of two angles.
    GivenPair(String),
    /// A line takes nothing from the caller.
    NoneGiven,
}

impl fmt::Display for SineFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            SineFault::Misnamed { name, sum } => write!(f, "`a{name}` is the sum {sum}"),
            SineFault::JointTwice => f.write_str("a joint twice in a sum"),
            SineFault::Unread(sum) => write!(f, "nothing reads `a{sum}`"),
            SineFault::OpenBlock => f.write_str("the block of an angle does not end"),
            SineFault::AfterAll => f.write_str("a call after that of all angles together"),
            SineFault::Uneven => f.write_str("as many sines, cosines and angles are expected"),
            SineFault::Untaken(angle) => {
                write!(f, "neither sine nor cosine of `{angle}` is taken")
            }
            SineFault::Uncalled(sum) => write!(f, "the sine of `a{sum}` is not called"),
            SineFault::Name { expected, found } => {
                write!(f, "`{expected}` or `_` expected, not `{found}`")
            }
            SineFault::UnevenNames => {
                f.write_str("as many names as sines and cosines are expected")
            }
            SineFault::GivenName { name, value } => write!(f, "`{name}` is no name of `{value}`"),
            SineFault::GivenPlace { name, value } => {
                write!(f, "`{name}` does not stand in `{value}`")
            }
            SineFault::GivenPair(name) => {
                write!(f, "`{name}` is not the other one of its angle")
            }
            SineFault::NoneGiven => f.write_str("no sine or cosine is given"),
        }
    }
}

impl std::error::Error for SineFault {}
