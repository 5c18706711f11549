//! What a certificate is about, and how its bounds are found.

use dalembert_model::scene::Scale;

use super::{Certificate, shape, work};
use crate::bound::definite::least_eigenvalue;
use crate::bound::input_box::InputBox;
use crate::bound::magnitude::{magnitudes, magnitudes_within, relative};
use crate::bound::sensitivity::{BoundEffort, Sensitivity};
use crate::dag::Dag;
use crate::edits::deviation;
use crate::language::{Printed, function};
use crate::program::{Library, Program, ScalarType, has_inertia};
use crate::setup::{SceneKey, Setup};
use crate::sincos::AngleKernel;
use crate::split::ErrorByCause;
use crate::states::JointState;
use crate::verify::exact::prove_same;
use crate::words::{Complaint, complaint};

/// A bound that exceeds its limit by more than this factor is not tried at the limit.
const NEAR: f64 = 1.07;

/// What a claim is about, whatever the scalar.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Subject<'a> {
    /// The full model.
    pub setup: &'a Setup,
    /// The exact program.
    pub exact: &'a Program,
    /// The program that is emitted, with exact constants.
    pub emitted: &'a Program,
    /// Where it holds.
    pub limits: &'a InputBox,
    /// T of each output.
    pub scales: &'a [f64],
    /// What the scales are, if they are one of these.
    pub relative_to: Option<Scale>,
    /// States at which the outputs reach them, if they are ranges.
    pub reached: &'a [JointState],
    /// The polynomials for sines; none if they are the library's.
    pub sines: &'a [AngleKernel],
    /// Who computes the sines that are called.
    pub library: Library,
}

impl Subject<'_> {
    /// Checks that the programs of a variant are of the function in this scene, and take bounded
    /// work.
    ///
    /// # Errors
    /// Why the variant is none.
    pub(crate) fn check(&self) -> Result<(), Complaint> {
        let programs = [
            ("the exact program", self.exact),
            ("the emitted program", self.emitted),
        ];
        let malformed = complaint(
            "the variant is malformed: a list has the wrong length, or a step reads a step that \
             does not come before it",
        );
        if !programs.iter().all(|(_, own)| own.dag.is_straight()) {
            return Err(malformed);
        }
        for (name, program) in programs {
            work::check(name, program)?;
        }
        if !shape::has_lists(self) {
            return Err(malformed);
        }
        for (name, program) in programs {
            shape::check(name, program, self)?;
        }
        Ok(())
    }

    /// Returns the largest errors of the edits, one an output, in its unit: the part
    /// of the bounds that every scalar shares, and the longest to find. If there are limits, an
    /// output that is a little above its own is shown to be at most that, if it can be: bounds by
    /// themselves exceed what is reached by some hundredths.
    pub(crate) fn model(&self, limits: &[f64], bound_effort: BoundEffort) -> Vec<f64> {
        if is_same(self.exact, self.emitted) {
            return vec![0.0; self.scales.len()];
        }
        let error = deviation(self.exact, self.emitted);
        let budget = bound_effort.budget;
        let mut found = magnitudes(&error, self.limits, self.scales, budget);
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
            let shown = magnitudes_within(&error, self.limits, &above_limits, budget);
            for (index, shown) in above.into_iter().zip(shown.unwrap_or_default()) {
                found[index] = shown;
            }
        }
        found
    }

    /// Bounds by cause, relative to the scales, with the edits' and the
    /// sensitivity at hand.
    pub(crate) fn bounds(
        &self,
        scalar: ScalarType,
        model: &[f64],
        sensitivity: &Sensitivity,
    ) -> Vec<ErrorByCause> {
        let mut bounds = self.rounding(scalar, sensitivity);
        for ((bound, &error), &scale) in bounds.iter_mut().zip(model).zip(self.scales) {
            bound.model = relative(error, scale);
        }
        bounds
    }

    /// Returns what sines and rounding cost, relative to the scales.
    pub(crate) fn rounding(
        &self,
        scalar: ScalarType,
        sensitivity: &Sensitivity,
    ) -> Vec<ErrorByCause> {
        let found = sensitivity.rounding(scalar, self.sines);
        let pairs = found.iter().zip(self.scales);
        pairs
            .map(|(rounding, &scale)| ErrorByCause {
                model: 0.0,
                sincos: relative(rounding.sincos, scale),
                rounding: relative(rounding.arithmetic, scale),
            })
            .collect()
    }

    /// Returns a lower bound of the least eigenvalue of S D S, if D is an output and
    /// not the model's; `None` as well if there is none above zero.
    pub(crate) fn least_eigenvalue(&self, scalar: ScalarType) -> Option<f64> {
        // The cheap questions first.
        let is_changed = || !self.sines.is_empty() || !is_same(self.exact, self.emitted);
        if !has_inertia(self.emitted) || !is_changed() {
            return None;
        }
        least_eigenvalue(self.emitted, scalar, self.sines, self.limits).ok()
    }

    /// Returns the claim for a scalar with these bounds, whether they hold or not;
    /// nothing is claimed of the least eigenvalue.
    pub(crate) fn claim(&self, scalar: ScalarType, bounds: Vec<ErrorByCause>) -> Certificate {
        Certificate {
            scene: self.setup.scene().map(SceneKey::new),
            scalar,
            limits: self.limits.clone(),
            scales: self.scales.to_vec(),
            relative_to: self.relative_to,
            reached: self.reached.to_vec(),
            exact: self.exact.clone(),
            emitted: self.emitted.clone(),
            text: printed(self.emitted, scalar, self.library, self.sines),
            library: self.library,
            sines: self.sines.to_vec(),
            bounds,
            lambda_min: None,
        }
    }
}

/// Returns whether two programs are the same function: what differs is rounding.
pub(crate) fn is_same(exact: &Program, emitted: &Program) -> bool {
    exact == emitted || prove_same(exact, emitted).is_ok()
}

/// Returns the text of a claim: a program and its sines, printed by themselves.
pub(super) fn printed(
    program: &Program,
    scalar: ScalarType,
    library: Library,
    sines: &[AngleKernel],
) -> String {
    let code = program.code(scalar, library, sines);
    function::write(&Printed::of(program, &code), library, &[])
}
