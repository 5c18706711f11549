//! The check of a variant, and the bounds of its claim.

use super::{Certificate, shape, work};
use crate::bound::definite::least_eigenvalue;
use crate::bound::magnitude::{magnitudes, magnitudes_within, relative};
use crate::bound::sensitivity::{BoundEffort, Sensitivity};
use crate::dag::Dag;
use crate::edits::deviation;
use crate::program::{Program, ScalarType, has_inertia};
use crate::setup::Setup;
use crate::split::ErrorByCause;
use crate::verify::exact::prove_same;
use crate::words::Complaint;

/// A bound that exceeds its limit by more than this factor is not tried at the limit.
const NEAR: f64 = 1.07;

impl Certificate {
    pub(crate) fn check(&self, setup: &Setup) -> Result<(), Complaint> {
        let programs = [
            ("the exact program", &self.exact),
            ("the emitted program", &self.emitted),
        ];
        for (name, program) in programs {
            work::check(name, program)?;
            shape::check(name, program, setup, &self.emitted)?;
        }
        Ok(())
    }

    /// `limits` are in the outputs' units, the result is relative to the scales. An output a little
    /// above its limit is shown to be at most that, where it can be.
    pub(crate) fn model(&self, limits: &[f64], bound_effort: BoundEffort) -> Vec<f64> {
        if is_same(&self.exact, &self.emitted) {
            return vec![0.0; self.scales.len()];
        }
        let error = deviation(&self.exact, &self.emitted);
        let budget = bound_effort.budget;
        let mut found = magnitudes(&error, &self.limits, &self.scales, budget);
        let pairs = || found.iter().zip(limits);
        let is_above = |(x, limit): (&f64, &f64)| x > limit;
        if pairs().all(|(x, limit)| *x <= NEAR * limit) && pairs().any(is_above) {
            let mut above = Vec::from_iter(0..limits.len());
            above.retain(|&i| found[i] > limits[i]);
            let above_limits: Vec<f64> = above.iter().map(|&i| limits[i]).collect();
            let error = Dag {
                outputs: above.iter().map(|&i| error.outputs[i]).collect(),
                ..error
            };
            let shown = magnitudes_within(&error, &self.limits, &above_limits, budget);
            for (index, shown) in above.into_iter().zip(shown.unwrap_or_default()) {
                found[index] = shown;
            }
        }
        let pairs = found.iter().zip(&self.scales);
        pairs.map(|(&x, &scale)| relative(x, scale)).collect()
    }

    pub(crate) fn rounding(
        &self,
        scalar: ScalarType,
        sensitivity: &Sensitivity,
    ) -> Vec<ErrorByCause> {
        let found = sensitivity.rounding(scalar, &self.sines);
        let pairs = found.iter().zip(&self.scales);
        pairs
            .map(|(rounding, &scale)| ErrorByCause {
                model: 0.0,
                sincos: relative(rounding.sincos, scale),
                rounding: relative(rounding.arithmetic, scale),
            })
            .collect()
    }

    /// The matrix is S D S; `None` if D is no output, is the model's, or has no bound above zero.
    pub(super) fn least_eigenvalue(&self, scalar: ScalarType) -> Option<f64> {
        let is_changed = || !self.sines.is_empty() || !is_same(&self.exact, &self.emitted);
        if !has_inertia(&self.emitted) || !is_changed() {
            return None;
        }
        least_eigenvalue(&self.emitted, scalar, &self.sines, &self.limits).ok()
    }
}

pub(crate) fn is_same(exact: &Program, emitted: &Program) -> bool {
    exact == emitted || prove_same(exact, emitted).is_ok()
}
