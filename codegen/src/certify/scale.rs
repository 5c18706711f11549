//! T: what errors are relative to.

use dalembert_model::number::{Rational, Rounded};
use dalembert_model::robot::Robot;

use super::attack::{run, text};
use super::input_box::{InputBox, MissingLimit};
use super::sample::{climb, draw};
use super::sensitivity::rounding;
use crate::emit::ScalarType;
use crate::function::Quantity;
use crate::schedule::Program;
use crate::simplify::random::Random;
use crate::verify::states::JointState;
use crate::verify::text::TextError;

/// The torque limits of the actuators, for a program whose results are
/// torques of its rows.
///
/// # Errors
/// A joint without a torque limit, or a result that is no torque.
pub fn actuator(robot: &Robot, program: &Program) -> Result<Vec<f64>, MissingLimit> {
    let torque = |&joint: &usize| {
        let limit: Option<&Rational> = robot.joints[joint].limits.torque.as_ref();
        let missing = MissingLimit {
            joint,
            limit: "torque",
        };
        // Down, so that an error relative to it is rounded up.
        let value = limit.map(|limit| f64::nearest_rational(limit).next_down());
        value.ok_or(missing)
    };
    let vectors = program.function.quantities().iter();
    let mut scales = Vec::new();
    for quantity in vectors {
        match quantity {
            Quantity::Torque | Quantity::Coriolis | Quantity::Gravity => {
                for joint in &program.rows {
                    scales.push(torque(joint)?);
                }
            }
            Quantity::Inertia | Quantity::Christoffel => {
                return Err(MissingLimit {
                    joint: 0,
                    limit: "torque (a matrix has none)",
                });
            }
        }
    }
    Ok(scales)
}

/// The largest magnitude of each output at actual states: a lower bound of
/// the range, so an error relative to it is not understated.
///
/// # Errors
/// The program cannot be printed and read back: a defect of this library.
pub fn range(program: &Program, limits: &InputBox) -> Result<Vec<f64>, TextError> {
    let exact = text(program, ScalarType::F64)?;
    let granted = rounding(program, ScalarType::F64, limits, 64);
    let mut random = Random::new(0x7a46e);
    let mut most = vec![0.0f64; program.outputs.len()];
    for output in 0..most.len() {
        let mut size = |state: &JointState| run(&exact, ScalarType::F64, state)[output].abs();
        for _ in 0..12 {
            let from = draw(limits, &mut random);
            let (_, found) = climb(limits, from, 1500, &mut random, &mut size);
            most[output] = most[output].max(found);
        }
        let lost = granted[output].arithmetic + granted[output].sincos;
        most[output] = (most[output] - lost).next_down().max(0.0);
    }
    Ok(most)
}
