//! What a tolerance admitted, with its certificates.

use super::error::ToleranceError;
use crate::bound::ranges::{RANGE_BOXES, overflows};
use crate::certificate::Certificate;
use crate::edits::{Stage, has_edits};
use crate::program::{Program, ScalarType, has_inertia};
use crate::split::ErrorByCause;

/// A variant that meets its tolerance.
#[derive(Clone, Debug)]
pub struct Admitted {
    /// What was edited, program after program; none if nothing was.
    pub stages: Vec<Stage>,
    /// The program to emit.
    pub program: Program,
    /// One a scalar, as they were asked for.
    pub certificates: Vec<Certificate>,
    /// What is claimed of each with libm's sines, which plans keep.
    pub libm: Vec<Claim>,
}

/// What is claimed of a variant in a scalar.
#[derive(Clone, Debug, PartialEq)]
pub struct Claim {
    /// The scalar.
    pub scalar: ScalarType,
    /// E of each output.
    pub bounds: Vec<ErrorByCause>,
    /// [`Certificate::lambda_min`].
    pub lambda_min: Option<f64>,
}

impl Admitted {
    pub(super) fn of(
        stages: &[Stage],
        emitted: &Program,
        certificates: Vec<Certificate>,
    ) -> Admitted {
        let claim = |certificate: &Certificate| Claim {
            scalar: certificate.scalar,
            bounds: certificate.bounds.clone(),
            lambda_min: certificate.lambda_min,
        };
        Admitted {
            stages: stages.to_vec(),
            program: emitted.clone(),
            libm: certificates.iter().map(claim).collect(),
            certificates,
        }
    }

    /// Returns whether D, if it is an output and was edited, is positive definite.
    pub fn is_definite(&self) -> bool {
        let certain = |certificate: &Certificate| certificate.lambda_min.is_some();
        !has_edits(&self.stages)
            || !has_inertia(&self.program)
            || self.certificates.iter().all(certain)
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
