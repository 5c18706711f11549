//! Certificates: claims about emitted code that anybody can check again.
//!
//! A certificate holds the exact program, the edits, the emitted program and
//! its printed text, and for each output a bound E of
//! |emitted code in its scalar − full model| / T over the box, split by cause.
//! Here they are made and written. `dalembert-checker`, which shares no line with this
//! crate, takes box, T, E and text from one and checks it.
//!
//! The emitted program and the edited one are the same function but not the
//! same arithmetic; rounding is bounded on the emitted one, edits between
//! exact programs, and the two add up by the triangle inequality.
//!
//! - this file: the claim, and how it is made
//! - `check`: that edits lead from program to program, which is proved of what was found and
//!   of what a plan kept; `work` and `shape`: what comes first; `bounds`: a plan's bounds,
//!   found anew; `refuted`: why these are not so
//! - [`subject`]: what a claim is about, and how its bounds are found

mod bounds;
mod check;
mod refuted;
mod shape;
pub(crate) mod subject;
mod work;

use dalembert_model::robot::Robot;
use dalembert_model::scene::Scale;

use crate::bound::input_box::InputBox;
use crate::bound::sensitivity::BoundEffort;
use crate::bound::sensitivity::Sensitivity;
use crate::bound::turns::turns_freely;
use crate::edits::Stage;
use crate::interval::Interval;
use crate::program::{Library, Program, ScalarType};
use crate::setup::SceneKey;
use crate::setup::Setup;
use crate::sincos::Sines;
use crate::split::ErrorByCause;
use crate::states::JointState;
pub(crate) use bounds::Shared;
pub use refuted::Refuted;
pub(crate) use refuted::WrongInput;
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
    /// The exact program and its edits, program after program.
    pub stages: Vec<Stage>,
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
    /// `stages` are what was edited; none for an exact program.
    pub fn make(
        robot: &Robot,
        stages: &[Stage],
        emitted: &Program,
        scalar: ScalarType,
        limits: &InputBox,
        scales: &[f64],
    ) -> Certificate {
        let subject = Subject {
            setup: &Setup::whole(robot),
            stages,
            emitted,
            limits,
            scales,
            relative_to: None,
            reached: &[],
            sines: &[],
            library: Library::Libm,
        };
        let bound_effort = BoundEffort::CERTIFY;
        let sensitivity = subject.sensitivity(bound_effort);
        let bounds = subject.bounds(scalar, &subject.model(bound_effort), &sensitivity);
        let lambda_min = subject.least_eigenvalue(scalar);
        Certificate {
            lambda_min,
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
            stages: vec![Stage::unedited(self.emitted.clone())],
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
        let sines = [(self.scalar, sines.clone())];
        let subject = self.subject(setup, &sines);
        let scaled = self.bounds.iter().map(|bound| bound.model);
        let mut bounds = subject.bounds(self.scalar, &vec![0.0; self.scales.len()], sensitivity);
        for (bound, model) in bounds.iter_mut().zip(scaled) {
            bound.model = model;
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
        let other = Certificate {
            emitted,
            ..self.clone()
        };
        other.with_sines(setup, &self.sines, sensitivity)
    }

    /// Returns the claim about the text that calls this library, unless polynomials give its
    /// sines. The bounds stay: the sines of every library are taken to be within one ulp.
    #[must_use]
    pub fn calling(&self, library: Library) -> Certificate {
        if !self.sines.is_empty() || self.library == library {
            return self.clone();
        }
        let other = Certificate {
            library,
            ..self.clone()
        };
        other.printed()
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

    fn subject<'a>(&'a self, setup: &'a Setup, sines: &'a [(ScalarType, Sines)]) -> Subject<'a> {
        Subject {
            setup,
            stages: &self.stages,
            emitted: &self.emitted,
            limits: &self.limits,
            scales: &self.scales,
            relative_to: self.relative_to,
            reached: &self.reached,
            sines,
            // Polynomials call nothing.
            library: match sines.iter().all(|(_, sines)| sines.is_empty()) {
                true => self.library,
                false => Library::Libm,
            },
        }
    }
}
