//! The exact proof: the final program equals Lagrange–Euler as written.
//!
//! Both are evaluated at random points of the field of integers modulo
//! 2⁶¹ − 1, with the exact constants. The points differ from those of the
//! search's fingerprints. Above [`WRITTEN_LIMIT`] joints the yardstick is the
//! link-frame recursion in the field, itself proved against Lagrange–Euler
//! for every joint kind and convention at up to that many joints by tests.

use std::fmt;

use dalembert_model::equations::{Arm, Formulation};
use dalembert_model::number::Exact;
use dalembert_model::robot::Robot;
use dalembert_model::scalar::Scalar;
use dalembert_model::scalar::field::Field;

use super::degree::{Degree, failure_exponent};
use crate::graph::Points;
use crate::graph::print::POINTS;
use crate::scene::Setting;
use crate::schedule::{Operand, Operation, Program};
use crate::trace::evaluate;

/// The most joints for which Lagrange–Euler itself is the yardstick: its cost
/// grows with n⁴ to n⁵.
pub const WRITTEN_LIMIT: usize = 10;

/// The seed of the proof's points: not the search's.
const SEED: u64 = 0x0070_7265_7566;

/// What was proved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Proof {
    /// The formula that the program equals.
    pub yardstick: Formulation,
    /// At how many random points.
    pub points: usize,
    /// Degree of the difference in the random parameters, from above.
    pub degree: u64,
    /// The probability of a miss is below 10 to the power of this.
    pub failure_exponent: i32,
}

/// Why a program is not the formula.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Disproof {
    /// An output differs at a point.
    Output {
        /// Which output, flat.
        index: usize,
        /// Its name, one-based.
        entry: String,
    },
    /// The program has another number of outputs.
    Shape,
    /// A parameter's denominator is divisible by 2⁶¹ − 1.
    Denominator,
}

impl fmt::Display for Proof {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let formula = match self.yardstick {
            Formulation::LagrangeEuler => "Lagrange–Euler as written",
            _ => "the Newton–Euler recursion",
        };
        write!(
            f,
            "equals {formula} at {} random points modulo 2^61 - 1 (degree {}, chance of a miss below 1e{})",
            self.points, self.degree, self.failure_exponent
        )
    }
}

impl fmt::Display for Disproof {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Disproof::Output { entry, .. } => {
                write!(f, "{entry} differs from the formula as written")
            }
            Disproof::Shape => f.write_str("the number of outputs differs from the formula's"),
            Disproof::Denominator => f.write_str(
                "a parameter has a denominator divisible by 2^61 - 1: write it as a decimal",
            ),
        }
    }
}

impl std::error::Error for Disproof {}

/// Proves a program of a whole robot.
pub fn prove(robot: &Robot, program: &Program) -> Result<Proof, Disproof> {
    prove_in(&Setting::whole(robot), program)
}

/// Proves a program of a setting: against the full arm's formula with
/// constants in place of what the setting fixes, whatever was merged.
pub fn prove_in(setting: &Setting, program: &Program) -> Result<Proof, Disproof> {
    if program.rows != setting.rows() {
        return Err(Disproof::Shape);
    }
    let robot = setting.robot();
    let yardstick = if robot.joints.len() <= WRITTEN_LIMIT {
        Formulation::LagrangeEuler
    } else {
        Formulation::NewtonEulerLink
    };
    let points = Points::independent(SEED);
    for point in 0..POINTS {
        let expected = points
            .evaluate(setting, program.function, yardstick, point)
            .ok_or(Disproof::Denominator)?;
        let actual = run(program, &points, point).ok_or(Disproof::Denominator)?;
        if expected.len() != actual.len() {
            return Err(Disproof::Shape);
        }
        if let Some(index) = (0..actual.len()).find(|&i| actual[i] != expected[i]) {
            let entry = program.entry(index);
            return Err(Disproof::Output { index, entry });
        }
    }
    let constant = |constant: &Exact| {
        if constant.is_zero() {
            Degree::zero()
        } else {
            Degree::constant(constant)
        }
    };
    let arm = Arm::from_robot(robot, &mut { constant });
    let motion = setting.motion(Degree::input, constant);
    let formula = evaluate(program.function, yardstick, &arm, &motion);
    let formula = setting.select(program.function, setting.joints(), formula);
    let degree = formula
        .iter()
        .zip(&program.degrees())
        .map(|(a, b)| a.add(b).bound())
        .max()
        .unwrap_or(0);
    Ok(Proof {
        yardstick,
        points: POINTS,
        degree,
        failure_exponent: failure_exponent(degree, program.outputs.len(), POINTS),
    })
}

/// The program in the field; `None` if a constant has no residue.
pub(crate) fn run(program: &Program, points: &Points, point: usize) -> Option<Vec<Field>> {
    let read = |operand: &Operand, steps: &[Field]| match operand {
        Operand::Input(input) => Some(points.input(*input).0[point]),
        Operand::Constant(constant) => Some(points.constant(constant)?.0[point]),
        Operand::Step(index) => Some(steps[*index]),
    };
    let mut steps = Vec::with_capacity(program.steps.len());
    for step in &program.steps {
        let (left, right) = (read(&step.left, &steps)?, read(&step.right, &steps)?);
        steps.push(match step.operation {
            Operation::Add => left.add(&right),
            Operation::Sub => left.sub(&right),
            Operation::Mul => left.mul(&right),
        });
    }
    program
        .outputs
        .iter()
        .map(|output| {
            let value = read(&output.value, &steps)?;
            Some(if output.negative { value.neg() } else { value })
        })
        .collect()
}

impl Program {
    /// The name of an output: `D_12`, `h_346`.
    pub fn entry(&self, mut index: usize) -> String {
        for quantity in self.function.quantities() {
            let len = quantity.len(self.rows.len());
            if index < len {
                return quantity.entry_over(index, &self.rows, self.joints);
            }
            index -= len;
        }
        format!("output {index}")
    }
}
