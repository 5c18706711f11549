//! Variants that a tolerance admits, with their claims.

use super::error::ToleranceError;
use crate::bound::ranges::{RANGE_BOXES, overflows};
use crate::certificate::Certificate;
use crate::certificate::subject::is_same;
use crate::edits::Omission;
use crate::program::{Program, has_inertia};
use crate::split::ErrorByCause;

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
    /// [`ToleranceError::Above`] with the first that is not;
    /// [`ToleranceError::Overflow`].
    pub fn within(&self, tolerances: &[f64]) -> Result<(), ToleranceError> {
        self.certificates
            .iter()
            .try_for_each(|c| within(c, tolerances))
    }
}

/// Returns whether every E of a certificate is within its output's tolerance, and nothing
/// overflows.
///
/// # Errors
/// As of [`Admitted::within`].
pub(super) fn within(certificate: &Certificate, tolerances: &[f64]) -> Result<(), ToleranceError> {
    let mut pairs = certificate.bounds.iter().zip(tolerances);
    // No number is within nothing.
    let within = |bound: &ErrorByCause, tolerance: f64| bound.total() <= tolerance;
    match pairs.position(|(bound, &tolerance)| !within(bound, tolerance)) {
        None => in_range(certificate),
        Some(index) => Err(ToleranceError::Above {
            entry: certificate.emitted.entry(index),
            scalar: certificate.scalar,
            tolerance: tolerances[index],
            bound: certificate.bounds[index],
        }),
    }
}

/// Bounds of rounding are of numbers that the scalar holds.
fn in_range(certificate: &Certificate) -> Result<(), ToleranceError> {
    let Certificate {
        emitted,
        scalar,
        sines,
        limits,
        ..
    } = certificate;
    match overflows(emitted, *scalar, sines, limits, RANGE_BOXES).first() {
        None => Ok(()),
        Some(&first) => Err(ToleranceError::Overflow {
            scalar: *scalar,
            first,
        }),
    }
}
