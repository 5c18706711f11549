//! Claims about variants: what a tolerance left of an exact program.
//!
//! A claim has the exact program, the emitted one and its printed text, and for each output a
//! bound E of |emitted code in its scalar − full model| / T over the box, split by cause.
//! `dalembert-checker`, which shares no formula with this crate, checks it.
//!
//! Rounding is bounded on the emitted program, and what it differs from the exact one between
//! exact programs; the two add up by the triangle inequality.
//!
//! - this file: the claim, and how it is made
//! - `shape` and `work`: a variant that a plan kept fits the scene, and is bounded in bounded time
//! - [`bounds`]: how its bounds are found

pub(crate) mod bounds;
mod shape;
mod work;

use dalembert_model::robot::Robot;
use dalembert_model::scene::Scale;

use crate::bound::input_box::{InputBox, turns_freely};
use crate::bound::sensitivity::{BoundEffort, Sensitivity};
use crate::interval::Interval;
use crate::language::function;
use crate::program::{Library, Program, ScalarType};
use crate::setup::SceneKey;
use crate::sincos::Sines;
use crate::split::ErrorByCause;
use crate::states::JointState;

/// A claim about one emitted function.
#[derive(Clone, Debug, PartialEq)]
pub struct Certificate {
    /// The scene, unless it is about the whole robot.
    pub scene: Option<SceneKey>,
    /// The scalar of the emitted code.
    pub scalar: ScalarType,
    /// Where it holds.
    pub limits: InputBox,
    /// T of each output, in its unit.
    pub scales: Vec<f64>,
    /// The named scale that errors are relative to, if any. It is checked.
    pub relative_to: Option<Scale>,
    /// If they are ranges, states at which the outputs reach them.
    pub reached: Vec<JointState>,
    /// The exact program.
    pub exact: Program,
    /// The program that is emitted, with exact constants.
    pub emitted: Program,
    /// The function as printed.
    pub text: String,
    /// Who computes its sines, unless polynomials do.
    pub library: Library,
    /// The polynomials for its sines; none if they are the library's.
    pub sines: Sines,
    /// E of each output.
    pub bounds: Vec<ErrorByCause>,
    /// A lower bound of the least eigenvalue of S D S over the box, if D is an output and something
    /// was left out; S is diagonal (`bound::definite`). Above zero, D is positive definite.
    pub lambda_min: Option<f64>,
}

impl Certificate {
    /// Returns the positions of a joint of this robot for which it holds; `None` for all. If a
    /// joint [turns freely](turns_freely), one turn is certified and its sine reaches further.
    pub fn positions(&self, robot: &Robot, joint: usize) -> Option<Interval> {
        if !turns_freely(robot, joint) {
            return self.limits.position.get(joint).copied();
        }
        let mut sines = self.sines.iter();
        sines
            .find(|sine| sine.joint == joint)
            .map(|sine| sine.range)
    }

    pub(crate) fn draft(
        exact: &Program,
        emitted: &Program,
        limits: &InputBox,
        scales: &[f64],
    ) -> Certificate {
        Certificate {
            scene: None,
            scalar: ScalarType::F64,
            limits: limits.clone(),
            scales: scales.to_vec(),
            relative_to: None,
            reached: Vec::new(),
            exact: exact.clone(),
            emitted: emitted.clone(),
            text: String::new(),
            library: Library::Libm,
            sines: Sines::new(),
            bounds: Vec::new(),
            lambda_min: None,
        }
    }

    pub(crate) fn bounded(
        self,
        scalar: ScalarType,
        model: &[f64],
        sensitivity: &Sensitivity,
    ) -> Certificate {
        let mut bounds = self.rounding(scalar, sensitivity);
        for (bound, &error) in bounds.iter_mut().zip(model) {
            bound.model = error;
        }
        Certificate {
            scalar,
            bounds,
            lambda_min: self.least_eigenvalue(scalar),
            ..self
        }
        .printed()
    }

    /// Bounds the emitted program's error and writes the claim down. `exact` may be `emitted`.
    pub fn make(
        exact: &Program,
        emitted: &Program,
        scalar: ScalarType,
        limits: &InputBox,
        scales: &[f64],
    ) -> Certificate {
        let bound_effort = BoundEffort::CERTIFY;
        let draft = Certificate::draft(exact, emitted, limits, scales);
        let sensitivity = Sensitivity::new(emitted, limits, bound_effort);
        let model = draft.model(&[], bound_effort);
        draft.bounded(scalar, &model, &sensitivity)
    }

    /// Returns the claim about sines and rounding, as if the emitted program were the full model.
    #[must_use]
    pub fn of_rounding(&self) -> Certificate {
        let bounds = self.bounds.iter().map(|bound| ErrorByCause {
            model: 0.0,
            ..*bound
        });
        Certificate {
            exact: self.emitted.clone(),
            bounds: bounds.collect(),
            ..self.clone()
        }
    }

    /// Returns the same claim with polynomials for sines; the edits' bounds stay.
    #[must_use]
    pub fn with_sines(&self, sines: &Sines, sensitivity: &Sensitivity) -> Certificate {
        let model: Vec<f64> = self.bounds.iter().map(|bound| bound.model).collect();
        let own = Certificate {
            // Polynomials call nothing.
            library: match sines.is_empty() {
                true => self.library,
                false => Library::Libm,
            },
            sines: sines.clone(),
            ..self.clone()
        };
        own.bounded(self.scalar, &model, sensitivity)
    }

    /// Returns the claim about the text that calls this library, unless polynomials give its
    /// sines. The bounds stay: the sines of every library are taken to be within one ulp.
    #[must_use]
    pub fn calling(&self, library: Library) -> Certificate {
        let own = self.clone();
        match self.sines.is_empty() && self.library != library {
            true => Certificate { library, ..own }.printed(),
            false => own,
        }
    }

    /// Returns the same claim with the text of its program.
    #[must_use]
    pub fn printed(self) -> Certificate {
        let (emitted, library) = (&self.emitted, self.library);
        let code = emitted.code(self.scalar, library, &self.sines);
        let text = function::write(emitted, &code, library, &[]);
        Certificate { text, ..self }
    }

    /// Returns E·T of each output.
    pub(crate) fn errors(&self) -> Vec<f64> {
        let pairs = self.bounds.iter().zip(&self.scales);
        // Up: the product of two doubles is one of the two next to it.
        pairs
            .map(|(bound, scale)| (bound.total() * scale).next_up())
            .collect()
    }
}
