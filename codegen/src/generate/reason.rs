//! Why there are no polynomials for sines.

use std::fmt;

use crate::approximate::error::NoPolynomials;
use crate::sincos::TooAccurate;

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
