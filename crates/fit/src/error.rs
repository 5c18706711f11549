//! The errors of inputs.

/// The errors of this crate.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Error {
    /// The robot has no base parameters that could be written down; the generator's reason.
    #[error("{0}")]
    NoBaseParameters(String),
    /// A slice is not as long as it has to be.
    #[error("`{argument}` has {found} values instead of {expected}")]
    Length {
        argument: &'static str,
        expected: usize,
        found: usize,
    },
    /// A value is NaN, infinite or beyond 1e100.
    #[error(
        "`{argument}[{index}]` is {found}: a finite number below 1e100 was expected; leave such \
         states out"
    )]
    Value {
        argument: &'static str,
        index: usize,
        found: f64,
    },
    /// Two accumulators, or one and a model, are over different columns.
    #[error(
        "the accumulators are over different columns: use one robot file and the same options for \
         all of them"
    )]
    OtherModel,
    /// Bytes are not an accumulator of this version.
    #[error("these bytes are not an accumulator: {0}")]
    Bytes(&'static str),
    /// There are fewer states than parameters of a torque, which its place among all tells.
    #[error(
        "torque {} has {needed} parameters at least, and there are {states} states: {} or more are \
         needed",
        joint + 1,
        needed + 1
    )]
    TooFew {
        joint: usize,
        states: u64,
        needed: u64,
    },
    /// A log can be validated only against others.
    #[error("cross-validation needs two logs or more: split the log in time")]
    OneFile,
    /// An option is out of range: what it has to be.
    #[error("{0}")]
    Option(&'static str),
    /// Positions are too far apart for the motion.
    #[error(
        "{rate:.0} states a second carry motion up to {most:.2} Hz, and the motion has {frequency} \
         Hz: give the frequency of the fastest motion in the log"
    )]
    TooFast {
        /// Positions a second.
        rate: f64,
        /// The highest frequency that they carry, Hz.
        most: f64,
        /// That of the motion, Hz.
        frequency: f64,
    },
    /// The search for consistent bodies did not converge.
    #[error(
        "no real bodies were found near the free parameters: look for mistakes in the logs where \
         the residuals are not small, else bring the robot file's masses near those of the arm"
    )]
    NotConverged,
}

/// Refuses an option unless it is good, by what it has to be.
pub(crate) fn ensure(is_good: bool, expected: &'static str) -> Result<(), Error> {
    is_good.then_some(()).ok_or(Error::Option(expected))
}

pub(crate) fn check(argument: &'static str, values: &[f64], expected: usize) -> Result<(), Error> {
    if values.len() != expected {
        return Err(Error::Length {
            argument,
            expected,
            found: values.len(),
        });
    }
    // Squares of what is accumulated have to stay in range.
    let unusable = |x: &f64| x.is_nan() || x.abs() > 1e100;
    // Without an end in the middle, so that it takes vectors: nearly always all is well.
    if !values.iter().fold(false, |any, x| any | unusable(x)) {
        return Ok(());
    }
    match values.iter().position(unusable) {
        None => Ok(()),
        Some(index) => Err(Error::Value {
            argument,
            index,
            found: values[index],
        }),
    }
}
