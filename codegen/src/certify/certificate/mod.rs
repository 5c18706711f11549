//! Certificates: claims about emitted code that anybody can check again.
//!
//! A certificate holds the exact program, the edits, the emitted program and
//! its printed text, and for each output a bound E of
//! |emitted code in its scalar − full model| / T over the box, split by cause.
//! [`Certificate::check`] trusts nothing in it:
//!
//! 1. the exact program equals the equations of motion (prime field); with a
//!    scene, those of the full robot with the scene's values in their places,
//!    the box is the scene's or larger, and E within its tolerance;
//! 2. each stage's edits apply, and what they give equals the next stage's
//!    program, the last one the emitted program (prime field, other points
//!    than any search uses);
//! 3. the printed text, read back, is the emitted program and nothing else,
//!    under its own signature, every literal rounded once; sines that it computes by polynomials are proved again
//!    from the literals, over the angles' ranges in the box;
//! 4. the error of the edits ([`difference`](super::edits::difference)), of sines and cosines and of
//!    rounding ([`sensitivity`](super::sensitivity)) are bounded anew, and the
//!    claims must not be smaller.
//!
//! The emitted program and the edited one are the same function but not the
//! same arithmetic; rounding is bounded on the emitted one, edits between
//! exact programs, and the two add up by the triangle inequality.
//!
//! - [`subject`]: what a claim is about, and how its bounds are found
//! - `split`: bounds by cause
//! - `refuted`: why a certificate is no good

mod refuted;
mod split;
pub mod subject;

use dalembert_model::robot::Robot;
use dalembert_model::scene::Scale;

use super::definite::{has_inertia, least_eigenvalue_with};
use super::edits::{Stage, has_edits};
use super::input_box::InputBox;
use super::ranges::{Finding, ranges_with};
use super::scale;
use super::sensitivity::Sensitivity;
use crate::emit::ScalarType;
use crate::graph::Points;
use crate::graph::print::POINTS;
use crate::plan::{SceneKey, input_hash};
use crate::scene::Setting;
use crate::schedule::Program;
use crate::sincos::proof::prove;
use crate::sincos::{self, Sines};
use crate::verify::exact::{Proof, prove_in, run};
use crate::verify::text::TextProgram;
pub use refuted::Refuted;
pub use split::Split;
use subject::{Fineness, Subject};

/// The seed of the points at which programs are compared.
const SEED: u64 = 0x6365_7274;

/// What a bound rests on besides arithmetic. The second is none where sines are
/// polynomials: their errors are proved.
pub const ASSUMPTIONS: [&str; 4] = [
    "every operation is rounded to nearest: (x op y)(1 + d) + e, |d| <= u, |e| <= least subnormal / 2 for products",
    "sin and cos are libm's, within one ulp",
    "no operation is contracted to a fused multiply-add",
    "positions, velocities and accelerations are the scalar's numbers inside the box",
];

/// How the bounds were found.
pub const METHOD: &str = "edits: program of the error, written out as a trigonometric polynomial, \
     at a grid with Riesz's and Bernstein's inequalities, or branch and bound with intervals; \
     rounding: largest values times largest adjoints, both written out in the same way, \
     or interval adjoints over sub-boxes";

/// A claim about one emitted function.
#[derive(Clone, Debug, PartialEq)]
pub struct Certificate {
    /// The robot's name.
    pub robot: String,
    /// The robot's input hash in hexadecimal; in a scene that of the robot
    /// with the scene's payload, gravity and box.
    pub input: String,
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
    /// The exact program and its edits, program after program.
    pub stages: Vec<Stage>,
    /// The program that is emitted, with exact constants.
    pub emitted: Program,
    /// The function as printed.
    pub text: String,
    /// The polynomials for its sines, with what is claimed of each; none if
    /// they are libm's.
    pub sines: Sines,
    /// E of each output.
    pub bounds: Vec<Split>,
    /// A lower bound of the least eigenvalue of S D S over the box, if D is
    /// an output and something was left out; S is diagonal
    /// ([`definite`](super::definite)). Above zero, D is positive definite.
    pub lambda_min: Option<f64>,
}

/// What a check found out.
#[derive(Clone, Debug, PartialEq)]
pub struct Checked {
    /// The exact program's proof.
    pub proof: Proof,
    /// The bounds found anew.
    pub bounds: Vec<Split>,
    /// What the scalar cannot hold; only warnings.
    pub findings: Vec<Finding>,
}

impl Certificate {
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
            setting: &Setting::whole(robot),
            stages,
            emitted,
            limits,
            scales,
            relative_to: None,
            sines: &[],
        };
        let fineness = Fineness::CERTIFY;
        let sensitivity = subject.sensitivity(fineness);
        let bounds = subject.bounds(scalar, &subject.model(fineness), &sensitivity);
        let lambda_min = subject.least_eigenvalue(scalar);
        Certificate {
            lambda_min,
            ..subject.claim(scalar, bounds)
        }
    }

    /// The claim's part about sines and rounding: of the emitted program by
    /// itself, as if that were the full model.
    #[must_use]
    pub fn of_rounding(&self) -> Certificate {
        let bounds = self.bounds.iter().map(|bound| Split {
            model: 0.0,
            ..*bound
        });
        Certificate {
            stages: vec![Stage::unedited(self.emitted.clone())],
            bounds: bounds.collect(),
            ..self.clone()
        }
    }

    /// The same claim with polynomials for sines; the edits' bounds stay.
    #[must_use]
    pub fn with_sines(
        &self,
        setting: &Setting,
        sines: &Sines,
        sensitivity: &Sensitivity,
    ) -> Certificate {
        let sines = [(self.scalar, sines.clone())];
        let subject = self.subject(setting, &sines);
        let scaled = self.bounds.iter().map(|bound| bound.model);
        let mut bounds = subject.bounds(self.scalar, &vec![0.0; self.scales.len()], sensitivity);
        for (bound, model) in bounds.iter_mut().zip(scaled) {
            bound.model = model;
        }
        // Sines that are further off move D.
        let least = self.lambda_min;
        Certificate {
            lambda_min: least.and_then(|_| subject.least_eigenvalue(self.scalar)),
            ..subject.claim(self.scalar, bounds)
        }
    }

    fn subject<'a>(
        &'a self,
        setting: &'a Setting,
        sines: &'a [(ScalarType, Sines)],
    ) -> Subject<'a> {
        Subject {
            setting,
            stages: &self.stages,
            emitted: &self.emitted,
            limits: &self.limits,
            scales: &self.scales,
            relative_to: self.relative_to,
            sines,
        }
    }

    /// Checks every part of the claim about a whole robot.
    ///
    /// # Errors
    /// The first part that is not so.
    pub fn check(&self, robot: &Robot) -> Result<Checked, Refuted> {
        self.check_in(&Setting::whole(robot))
    }

    /// Checks every part of the claim.
    ///
    /// # Errors
    /// The first part that is not so.
    pub fn check_in(&self, setting: &Setting) -> Result<Checked, Refuted> {
        if self.scene != setting.scene().map(SceneKey::of) {
            return Err(Refuted::Scene);
        }
        if self.input != input_hash(setting.robot()) || self.robot != setting.robot().name {
            return Err(Refuted::Robot);
        }
        self.check_shape(setting.robot())?;
        self.check_box(setting)?;
        self.check_scales(setting)?;
        self.check_tolerance(setting)?;
        let proof = prove_in(setting, &self.stages[0].program).map_err(Refuted::Exact)?;
        self.check_edits()?;
        let text = TextProgram::parse_alone(&self.text, &self.emitted, self.scalar)
            .map_err(|error| Refuted::Text(error.to_string()))?;
        text.matches_with(&self.emitted, self.scalar, &self.sines)
            .map_err(Refuted::Text)?;
        self.check_sines()?;
        let table = ranges_with(&self.emitted, self.scalar, &self.sines, &self.limits, 256);
        let findings = table.findings;
        if let Some(&finding) = findings.iter().find(|finding| finding.is_error()) {
            return Err(Refuted::Range(finding));
        }
        let sines = [(self.scalar, self.sines.clone())];
        let found = self.check_bounds(&self.subject(setting, &sines))?;
        self.check_definite()?;
        Ok(Checked {
            proof,
            bounds: found,
            findings,
        })
    }

    /// Each polynomial's errors are proved again, from its literals and over
    /// all values that its angle takes.
    fn check_sines(&self) -> Result<(), Refuted> {
        for (index, sine) in self.sines.iter().enumerate() {
            let trig = &self.emitted.trig;
            let is_read = trig.iter().any(|trig| trig.angle == sine.angle);
            let mut before = self.sines[..index].iter();
            if !is_read || before.any(|before| before.angle == sine.angle) {
                return Err(Refuted::Shape);
            }
            let angle = sincos::angle_name(sine.angle);
            let whole = sincos::range_of(sine.angle, &self.limits.position, self.scalar);
            let found = prove(&sine.kernel, self.scalar, sine.range);
            let claimed = sine.errors;
            match found {
                _ if !sine.range.encloses(whole) => return Err(Refuted::SineRange { angle }),
                Some(found) if found.sin <= claimed.sin && found.cos <= claimed.cos => {}
                found => {
                    return Err(Refuted::Sine {
                        angle,
                        claimed,
                        found,
                    });
                }
            }
        }
        Ok(())
    }

    /// Each stage's edits apply and give the program that follows.
    pub(super) fn check_edits(&self) -> Result<(), Refuted> {
        for (index, stage) in self.stages.iter().enumerate() {
            stage.check().map_err(|bad| Refuted::Edits(index, bad))?;
            let next = self.stages.get(index + 1).map(|next| &next.program);
            let edited = stage.program(crate::graph::Folding::Syntactic);
            if !same(&edited, next.unwrap_or(&self.emitted)) {
                return Err(Refuted::Step(index));
            }
        }
        Ok(())
    }

    /// D, if it was edited, must be claimed to be positive definite, and be.
    fn check_definite(&self) -> Result<(), Refuted> {
        if self.lambda_min.is_none() && !(has_edits(&self.stages) && has_inertia(&self.emitted)) {
            return Ok(());
        }
        let claimed = self.lambda_min.unwrap_or(0.0);
        let found = least_eigenvalue_with(&self.emitted, self.scalar, &self.sines, &self.limits)
            .map_err(Refuted::Indefinite)?;
        if claimed > 0.0 && claimed <= found {
            return Ok(());
        }
        Err(Refuted::Eigenvalue { claimed, found })
    }

    pub(super) fn check_shape(&self, robot: &Robot) -> Result<(), Refuted> {
        let (n, outputs) = (robot.joints.len(), self.emitted.outputs.len());
        let lists = [
            &self.limits.position,
            &self.limits.velocity,
            &self.limits.acceleration,
        ];
        let fits = !self.stages.is_empty()
            && lists.iter().all(|list| list.len() == n)
            && self.scales.len() == outputs
            && self.bounds.len() == outputs
            && self
                .stages
                .iter()
                .map(|stage| &stage.program)
                .chain([&self.emitted])
                .all(|p| {
                    p.joints == n
                        && p.outputs.len() == outputs
                        && p.rows == self.emitted.rows
                        && p.arguments == self.emitted.arguments
                });
        if fits { Ok(()) } else { Err(Refuted::Shape) }
    }

    /// The claims must be shown anew: by the coarse bound, as some were made, or
    /// by the fine one.
    fn check_bounds(&self, subject: &Subject<'_>) -> Result<Vec<Split>, Refuted> {
        let mut found: Option<Vec<Split>> = None;
        for fineness in [Fineness::GLANCE, Fineness::CERTIFY] {
            let sensitivity = subject.sensitivity(fineness);
            let next = subject.bounds(self.scalar, &subject.model(fineness), &sensitivity);
            let best = match found {
                None => next,
                Some(best) => best.iter().zip(&next).map(|(a, b)| a.min(*b)).collect(),
            };
            // A claim survives the shortest decimal of its double.
            if self.too_small(&best).is_none() {
                return Ok(best);
            }
            found = Some(best);
        }
        let found = found.unwrap_or_default();
        let index = self.too_small(&found).unwrap_or_default();
        Err(Refuted::Bound {
            entry: self.emitted.entry(index),
            claimed: self.bounds[index],
            found: found[index],
        })
    }

    /// The first claim that is smaller than what was found.
    fn too_small(&self, found: &[Split]) -> Option<usize> {
        let less = |claim: f64, found: f64| claim.is_nan() || claim < found;
        let mut pairs = self.bounds.iter().zip(found);
        pairs.position(|(claimed, found)| {
            less(claimed.model, found.model)
                || less(claimed.sincos, found.sincos)
                || less(claimed.rounding, found.rounding)
        })
    }

    /// A claim about a scene is one about all of its box.
    fn check_box(&self, setting: &Setting) -> Result<(), Refuted> {
        if setting.scene().is_none() {
            return Ok(());
        }
        let whole = InputBox::within(setting, self.emitted.function);
        match whole {
            Ok(whole) if self.limits.holds(&whole) => Ok(()),
            _ => Err(Refuted::Box),
        }
    }

    /// A claim about a scene with a tolerance is that it is met.
    fn check_tolerance(&self, setting: &Setting) -> Result<(), Refuted> {
        let scene = setting.scene();
        let Some(tolerance) = scene.and_then(|scene| scene.tolerance.as_ref()) else {
            return Ok(());
        };
        let allowed = scale::tolerances(&self.emitted, tolerance);
        let alike = self.relative_to == Some(tolerance.relative_to);
        let mut pairs = self.bounds.iter().zip(&allowed);
        // No number is within nothing.
        let within = |bound: &Split, allowed: f64| alike && bound.total() <= allowed;
        match pairs.position(|(bound, &allowed)| !within(bound, allowed)) {
            None => Ok(()),
            Some(index) => Err(Refuted::Tolerance {
                entry: self.emitted.entry(index),
                allowed: (allowed[index], tolerance.relative_to),
                claimed: (self.bounds[index].total(), self.relative_to),
            }),
        }
    }

    /// A larger T would make E smaller.
    fn check_scales(&self, setting: &Setting) -> Result<(), Refuted> {
        let exact = &self.stages[0].program;
        let found = match self.relative_to {
            None => return Ok(()),
            Some(Scale::Actuator) => scale::actuator(setting.robot(), exact).ok(),
            Some(Scale::Range) => scale::range(exact, &self.limits).ok(),
        };
        let found = found.ok_or(Refuted::Shape)?;
        let mut pairs = self.scales.iter().zip(&found);
        match pairs.position(|(claimed, found)| claimed.is_nan() || claimed > found) {
            None => Ok(()),
            Some(index) => Err(Refuted::Scale {
                entry: self.emitted.entry(index),
            }),
        }
    }
}

/// Whether two programs agree at points that no search has seen.
pub fn same(a: &Program, b: &Program) -> bool {
    let points = Points::independent(SEED);
    (0..POINTS).all(|point| {
        let (a, b) = (run(a, &points, point), run(b, &points, point));
        a.is_some() && a == b
    })
}
