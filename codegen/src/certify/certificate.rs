//! Certificates: claims about emitted code that anybody can check again.
//!
//! A certificate holds the exact program, the edits, the emitted program and
//! its printed text, and for each output a bound E of
//! |emitted code in its scalar − full model| / T over the box, split by cause.
//! [`Certificate::check`] trusts nothing in it:
//!
//! 1. the exact program equals the equations of motion (prime field);
//! 2. each stage's edits apply, and what they give equals the next stage's
//!    program, the last one the emitted program (prime field, other points
//!    than any search uses);
//! 3. the printed text, read back, is the emitted program, every literal
//!    rounded once;
//! 4. the error of the edits ([`difference`]), of sines and cosines and of
//!    rounding ([`rounding`]) are bounded anew, and the claims must not be
//!    smaller.
//!
//! The emitted program and the edited one are the same function but not the
//! same arithmetic; rounding is bounded on the emitted one, edits between
//! exact programs, and the two add up by the triangle inequality.

use std::fmt;

use dalembert_model::robot::Robot;

use super::bound::{Budget, magnitudes, relative};
use super::edits::{BadEdit, Stage, difference};
use super::input_box::InputBox;
use super::ranges::{Finding, ranges};
use super::sensitivity::rounding;
use crate::emit::{MathPath, ScalarType, function};
use crate::graph::Points;
use crate::graph::print::POINTS;
use crate::plan::input_hash;
use crate::schedule::Program;
use crate::verify::exact::{Disproof, Proof, prove, run};
use crate::verify::text::TextProgram;

/// The seed of the points at which programs are compared.
const SEED: u64 = 0x6365_7274;

/// Sub-boxes of the rounding bound.
pub const ROUNDING_BOXES: usize = 4096;

/// What a bound rests on besides arithmetic.
pub const ASSUMPTIONS: [&str; 4] = [
    "every operation is rounded to nearest: (x op y)(1 + d) + e, |d| <= u, |e| <= least subnormal / 2 for products",
    "sin and cos are libm's, within one ulp",
    "no operation is contracted to a fused multiply-add",
    "positions, velocities and accelerations are the scalar's numbers inside the box",
];

/// How the bounds were found.
pub const METHOD: &str = "edits: program of the error, written out as a trigonometric polynomial, \
     at a grid with Riesz's and Bernstein's inequalities, or branch and bound with intervals; \
     rounding: interval adjoints over sub-boxes";

/// A bound by cause, relative to T.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Split {
    /// Terms left out.
    pub model: f64,
    /// Sines and cosines.
    pub sincos: f64,
    /// Operations and constants.
    pub rounding: f64,
}

impl Split {
    /// E
    pub fn total(self) -> f64 {
        (self.model + self.sincos + self.rounding) * (1.0 + 1e-15)
    }
}

/// A claim about one emitted function.
#[derive(Clone, Debug, PartialEq)]
pub struct Certificate {
    /// The robot's name.
    pub robot: String,
    /// The robot's input hash in hexadecimal.
    pub input: String,
    /// The scalar of the emitted code.
    pub scalar: ScalarType,
    /// Where it holds.
    pub limits: InputBox,
    /// T of each output, in its unit.
    pub scales: Vec<f64>,
    /// The exact program and its edits, program after program.
    pub stages: Vec<Stage>,
    /// The program that is emitted, with exact constants.
    pub emitted: Program,
    /// The function as printed.
    pub text: String,
    /// E of each output.
    pub bounds: Vec<Split>,
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

/// Why a certificate is no good.
#[derive(Clone, Debug, PartialEq)]
pub enum Refuted {
    /// It is for another robot.
    Robot,
    /// A list has not as many entries as there are outputs or joints.
    Shape,
    /// The exact program is not the formula.
    Exact(Disproof),
    /// Edits cannot be applied.
    Edits(usize, BadEdit),
    /// A stage's edited program is not what follows.
    Step(usize),
    /// The text is not the emitted program.
    Text(String),
    /// The scalar cannot hold a value.
    Range(Finding),
    /// A claim is smaller than what can be shown.
    Bound {
        /// The output's name.
        entry: String,
        /// What is claimed.
        claimed: Split,
        /// What was found.
        found: Split,
    },
}

impl fmt::Display for Refuted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Refuted::Robot => f.write_str("the certificate is for another robot"),
            Refuted::Shape => f.write_str("a list is not as long as it should be"),
            Refuted::Exact(disproof) => write!(f, "the exact program: {disproof}"),
            Refuted::Edits(stage, bad) => write!(f, "stage {}: {bad}", stage + 1),
            Refuted::Step(stage) => write!(
                f,
                "stage {}: the edited program is not the one that follows",
                stage + 1
            ),
            Refuted::Text(why) => write!(f, "the printed text: {why}"),
            Refuted::Range(finding) => write!(f, "{finding}"),
            Refuted::Bound {
                entry,
                claimed,
                found,
            } => write!(
                f,
                "{entry}: claimed model {:e}, sincos {:e}, rounding {:e}; \
                 what can be shown is {:e}, {:e}, {:e}",
                claimed.model,
                claimed.sincos,
                claimed.rounding,
                found.model,
                found.sincos,
                found.rounding
            ),
        }
    }
}

impl std::error::Error for Refuted {}

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
        let stages = if stages.is_empty() {
            vec![Stage {
                program: emitted.clone(),
                edits: Vec::new(),
            }]
        } else {
            stages.to_vec()
        };
        let bounds = bounds(&stages, emitted, scalar, limits, scales);
        Certificate {
            robot: robot.name.clone(),
            input: input_hash(robot),
            scalar,
            limits: limits.clone(),
            scales: scales.to_vec(),
            stages,
            emitted: emitted.clone(),
            text: function::write(emitted, scalar, &MathPath::default(), &[]),
            bounds,
        }
    }

    /// Checks every part of the claim.
    ///
    /// # Errors
    /// The first part that is not so.
    pub fn check(&self, robot: &Robot) -> Result<Checked, Refuted> {
        if self.input != input_hash(robot) {
            return Err(Refuted::Robot);
        }
        self.check_shape(robot)?;
        let proof = prove(robot, &self.stages[0].program).map_err(Refuted::Exact)?;
        for (index, stage) in self.stages.iter().enumerate() {
            stage.check().map_err(|bad| Refuted::Edits(index, bad))?;
            let next = self.stages.get(index + 1).map(|next| &next.program);
            let edited = stage.program(crate::graph::Folding::Syntactic);
            if !same(&edited, next.unwrap_or(&self.emitted)) {
                return Err(Refuted::Step(index));
            }
        }
        let text = TextProgram::parse(&self.text, self.emitted.function, self.scalar)
            .map_err(|error| Refuted::Text(error.to_string()))?;
        text.matches(&self.emitted, self.scalar)
            .map_err(Refuted::Text)?;
        let findings = ranges(&self.emitted, self.scalar, &self.limits, 256).findings;
        if let Some(&finding) = findings.iter().find(|finding| finding.is_error()) {
            return Err(Refuted::Range(finding));
        }
        let found = bounds(
            &self.stages,
            &self.emitted,
            self.scalar,
            &self.limits,
            &self.scales,
        );
        for (index, (&claimed, &found)) in self.bounds.iter().zip(&found).enumerate() {
            // A claim survives the shortest decimal of its double.
            let less = |claim: f64, found: f64| claim.is_nan() || claim < found;
            if less(claimed.model, found.model)
                || less(claimed.sincos, found.sincos)
                || less(claimed.rounding, found.rounding)
            {
                return Err(Refuted::Bound {
                    entry: self.emitted.entry(index),
                    claimed,
                    found,
                });
            }
        }
        Ok(Checked {
            proof,
            bounds: found,
            findings,
        })
    }

    fn check_shape(&self, robot: &Robot) -> Result<(), Refuted> {
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
                .all(|p| p.joints == n && p.outputs.len() == outputs);
        if fits { Ok(()) } else { Err(Refuted::Shape) }
    }
}

/// Bounds by cause, relative to the scales.
fn bounds(
    stages: &[Stage],
    emitted: &Program,
    scalar: ScalarType,
    limits: &InputBox,
    scales: &[f64],
) -> Vec<Split> {
    let edited = stages.iter().any(|stage| !stage.edits.is_empty());
    let model = if edited {
        magnitudes(&difference(stages), limits, scales, 0.0, Budget::CERTIFY)
    } else {
        vec![0.0; scales.len()]
    };
    let rounding = rounding(emitted, scalar, limits, ROUNDING_BOXES);
    let all = model.iter().zip(&rounding).zip(scales);
    all.map(|((&model, rounding), &scale)| Split {
        model: relative(model, scale),
        sincos: relative(rounding.sincos, scale),
        rounding: relative(rounding.arithmetic, scale),
    })
    .collect()
}

/// Whether two programs agree at points that no search has seen.
pub fn same(a: &Program, b: &Program) -> bool {
    let points = Points::independent(SEED);
    (0..POINTS).all(|point| {
        let (a, b) = (run(a, &points, point), run(b, &points, point));
        a.is_some() && a == b
    })
}
