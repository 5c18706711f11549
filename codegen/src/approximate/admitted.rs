//! Variants that a tolerance admits, with their claims.

use super::error::ToleranceError;
use crate::bound::sensitivity::overflows;
use crate::certificate::Certificate;
use crate::certificate::bounds::is_same;
use crate::edits::Omission;
use crate::program::{Program, has_inertia};
use crate::split::ErrorByCause;
use crate::words::complaint;

const RANGE_BOXES: usize = 256;

/// A variant that meets its tolerance.
#[derive(Clone, Debug)]
pub struct Admitted {
    /// The exact program.
    pub exact: Program,
    /// The program to emit.
    pub program: Program,
    /// The values that were left out one by one; none of a smaller model.
    pub left_out: Vec<Omission>,
    /// One a scalar, as they were asked for.
    pub certificates: Vec<Certificate>,
}

impl Admitted {
    /// Returns whether it is another function than the exact program.
    pub fn is_other(&self) -> bool {
        !is_same(&self.exact, &self.program)
    }

    /// Returns whether D, if it is an output and was edited, is positive definite.
    pub fn is_definite(&self) -> bool {
        let certain = |certificate: &Certificate| certificate.lambda_min.is_some();
        !has_inertia(&self.program) || self.certificates.iter().all(certain) || !self.is_other()
    }

    /// Returns whether every E is within its output's tolerance, and nothing overflows.
    ///
    /// # Errors
    /// [`ToleranceError::Above`] with the first that is not; [`ToleranceError::Overflow`].
    pub fn within(&self, tolerances: &[f64]) -> Result<(), ToleranceError> {
        self.certificates
            .iter()
            .try_for_each(|c| within(c, tolerances))
    }
}

pub(super) fn within(certificate: &Certificate, tolerances: &[f64]) -> Result<(), ToleranceError> {
    let Certificate {
        emitted,
        scalar,
        sines,
        limits,
        bounds,
        ..
    } = certificate;
    let wider = scalar.of("", ", or choose a wider scalar");
    let mut pairs = bounds.iter().zip(tolerances);
    // False for a bound that is not a number.
    let within = |bound: &ErrorByCause, tolerance: f64| bound.total() <= tolerance;
    if let Some(index) = pairs.position(|(bound, &tolerance)| !within(bound, tolerance)) {
        let (entry, bound, tolerance) = (emitted.entry(index), bounds[index], tolerances[index]);
        return Err(ToleranceError::Above(complaint(format!(
            "no variant in {scalar} can be certified to keep {entry} within {tolerance:.1e}: with \
             nothing left out, the bound is {:.1e} for rounding and {:.1e} for sines and cosines; \
             allow more{wider}",
            bound.rounding, bound.sincos
        ))));
    }
    // Bounds of rounding are of numbers that the scalar holds.
    match overflows(emitted, *scalar, sines, limits, RANGE_BOXES).first() {
        None => Ok(()),
        Some(first) => Err(ToleranceError::Overflow(complaint(format!(
            "inside the box {first} in {scalar}, and no error is certified of what overflows: \
             bound the box, choose other units{wider}"
        )))),
    }
}
