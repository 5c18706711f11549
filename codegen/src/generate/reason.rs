//! Reasons that an error gives: what is wrong with a text, with sines, and with
//! code that was run.

use std::fmt;

use crate::approximate::error::NoPolynomials;
use crate::language::read::TextError;
use crate::program::Difference;
use crate::sincos::TooAccurate;

/// Why a printed text is not the program: a defect of this library.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TextDefect {
    /// Its module is not there.
    NoModule,
    /// It cannot be read back.
    Unreadable(Box<TextError>),
    /// What was read back is another program.
    Differs(Difference),
    /// What was read back costs something else.
    Counts,
}

impl fmt::Display for TextDefect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            TextDefect::NoModule => f.write_str("its module is not in the text"),
            TextDefect::Unreadable(error) => error.fmt(f),
            TextDefect::Differs(difference) => difference.fmt(f),
            TextDefect::Counts => f.write_str("the counts of the text differ"),
        }
    }
}

impl std::error::Error for TextDefect {}

/// Why there are no polynomials for sines.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum NoSines {
    /// None gives them as exactly as was wanted.
    TooAccurate(Box<TooAccurate>),
    /// An error was given for them in a scene with a tolerance, which decides.
    Decided,
    /// None is within the scene's tolerance.
    Tolerance(Box<NoPolynomials>),
    /// With errors of so much, D may not be positive definite any more.
    Indefinite {
        /// The largest error of each sine and cosine.
        error: f64,
    },
}

impl fmt::Display for NoSines {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NoSines::TooAccurate(error) => error.fmt(f),
            NoSines::Decided => f.write_str(
                "a scene's tolerance decides how exact its sines are: give no error for them",
            ),
            NoSines::Tolerance(why) => write!(
                f,
                "no polynomials for its sines within the tolerance: {why}"
            ),
            NoSines::Indefinite { error } => write!(
                f,
                "with sines that err by up to {error:e}, D cannot be shown to be positive definite \
                 any more: give a smaller error for them"
            ),
        }
    }
}

impl std::error::Error for NoSines {}

/// What was seen where proved code was run.
#[derive(Clone, Debug, PartialEq)]
pub struct Contradiction {
    /// The result's name.
    pub entry: String,
    /// How far it is off the robot's own recursion.
    pub error: f64,
    /// The most that it may be off.
    pub bound: f64,
    /// `true` if its certificate says how far, `false` if rounding does.
    pub is_claimed: bool,
}

impl fmt::Display for Contradiction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Contradiction {
            entry,
            error,
            bound,
            is_claimed,
        } = self;
        let most = match is_claimed {
            true => "its certificate allows",
            false => "rounding is no more than",
        };
        write!(
            f,
            "{entry} is {error:.3e} off the robot's own recursion, and {most} {bound:.3e}"
        )
    }
}

impl std::error::Error for Contradiction {}
