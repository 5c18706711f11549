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
//!
//! - `split`: bounds by cause
//! - `refuted`: why a certificate is no good

mod refuted;
mod split;

use dalembert_model::robot::Robot;

use super::edits::Stage;
use super::input_box::InputBox;
use super::ranges::{Finding, ranges};
use crate::emit::{MathPath, ScalarType, function};
use crate::graph::Points;
use crate::graph::print::POINTS;
use crate::plan::input_hash;
use crate::schedule::Program;
use crate::verify::exact::{Proof, prove, run};
use crate::verify::text::TextProgram;
pub use refuted::Refuted;
use split::bounds;
pub use split::{ROUNDING_BOXES, Split};

/// The seed of the points at which programs are compared.
const SEED: u64 = 0x6365_7274;

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

/// Whether two programs agree at points that no search has seen.
pub fn same(a: &Program, b: &Program) -> bool {
    let points = Points::independent(SEED);
    (0..POINTS).all(|point| {
        let (a, b) = (run(a, &points, point), run(b, &points, point));
        a.is_some() && a == b
    })
}
