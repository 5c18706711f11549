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
//! - [`subject`]: what a claim is about, and how its bounds are found

mod shape;
pub(crate) mod subject;
mod work;

use dalembert_model::robot::Robot;
use dalembert_model::scene::Scale;

use crate::bound::input_box::InputBox;
use crate::bound::sensitivity::{BoundEffort, Sensitivity};
use crate::bound::turns::turns_freely;
use crate::interval::Interval;
use crate::program::{Library, Program, ScalarType};
use crate::setup::{SceneKey, Setup};
use crate::sincos::{AngleKernel, Sines};
use crate::split::ErrorByCause;
use crate::states::JointState;
use subject::{Subject, printed};

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
    /// What the scales are, if they are one of these: then that is checked.
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
    /// The polynomials for its sines, with what is claimed of each; none if
    /// they are the library's.
    pub sines: Sines,
    /// E of each output.
    pub bounds: Vec<ErrorByCause>,
    /// A lower bound of the least eigenvalue of S D S over the box, if D is
    /// an output and something was left out; S is diagonal
    /// (`bound::definite`). Above zero, D is positive definite.
    pub lambda_min: Option<f64>,
}

impl Certificate {
    /// Returns the positions of a joint of this robot for which it holds; `None` for all.
    ///
    /// Where a joint [turns freely](turns_freely), one turn is certified and its
    /// sine reaches further: so does the certificate.
    pub fn positions(&self, robot: &Robot, joint: usize) -> Option<Interval> {
        if !turns_freely(robot, joint) {
            return self.limits.position.get(joint).copied();
        }
        let mut sines = self.sines.iter();
        sines
            .find(|sine| sine.joint == joint)
            .map(|sine| sine.range)
    }

    /// Bounds the emitted program's error and writes the claim down.
    ///
    /// The exact program may be the one that is emitted.
    pub fn make(
        robot: &Robot,
        exact: &Program,
        emitted: &Program,
        scalar: ScalarType,
        limits: &InputBox,
        scales: &[f64],
    ) -> Certificate {
        let subject = Subject {
            setup: &Setup::whole(robot),
            exact,
            emitted,
            limits,
            scales,
            relative_to: None,
            reached: &[],
            sines: &[],
            library: Library::Libm,
        };
        let bound_effort = BoundEffort::CERTIFY;
        let sensitivity = Sensitivity::new(emitted, limits, bound_effort);
        let bounds = subject.bounds(scalar, &subject.model(&[], bound_effort), &sensitivity);
        Certificate {
            lambda_min: subject.least_eigenvalue(scalar),
            ..subject.claim(scalar, bounds)
        }
    }

    /// Returns the claim's part about sines and rounding: of the emitted program by
    /// itself, as if that were the full model.
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
    pub fn with_sines(
        &self,
        setup: &Setup,
        sines: &Sines,
        sensitivity: &Sensitivity,
    ) -> Certificate {
        let subject = self.subject(setup, sines);
        let mut bounds = subject.rounding(self.scalar, sensitivity);
        for (bound, known) in bounds.iter_mut().zip(&self.bounds) {
            bound.model = known.model;
        }
        Certificate {
            // Sines that are off move D.
            lambda_min: subject.least_eigenvalue(self.scalar),
            ..subject.claim(self.scalar, bounds)
        }
    }

    /// Returns the same claim with another program for what is emitted, which is the same
    /// function: the edits' bounds stay.
    #[must_use]
    pub fn with_emitted(
        &self,
        setup: &Setup,
        emitted: Program,
        sensitivity: &Sensitivity,
    ) -> Certificate {
        let own = self.clone();
        Certificate { emitted, ..own }.with_sines(setup, &self.sines, sensitivity)
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
        let text = printed(&self.emitted, self.scalar, self.library, &self.sines);
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

    fn subject<'a>(&'a self, setup: &'a Setup, sines: &'a [AngleKernel]) -> Subject<'a> {
        Subject {
            setup,
            exact: &self.exact,
            emitted: &self.emitted,
            limits: &self.limits,
            scales: &self.scales,
            relative_to: self.relative_to,
            reached: &self.reached,
            sines,
            // Polynomials call nothing.
            library: match sines.is_empty() {
                true => self.library,
                false => Library::Libm,
            },
        }
    }
}
