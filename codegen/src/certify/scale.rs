//! T: what errors are relative to, and how large they may be against it.

use dalembert_model::number::{Rational, Rounded};
use dalembert_model::robot::{Limits, Robot};
use dalembert_model::scene::Tolerance;

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

/// The torque limits of the actuators. For an entry of D the inertia, for one
/// of h_ikm the coefficient, that alone takes the whole limit at the largest
/// rates, of the smaller of D_ik and D_ki: then D's scales are symmetric.
///
/// # Errors
/// A joint without a limit that this needs, or with one of zero.
pub fn actuator(robot: &Robot, program: &Program) -> Result<Vec<f64>, MissingLimit> {
    let read = |joint: usize, limit: &'static str, value: fn(&Limits) -> &Option<Rational>| {
        let value = robot.joints.get(joint).map(|row| value(&row.limits));
        let value = value.and_then(Option::as_ref).map(f64::nearest_rational);
        let zero = value.is_some();
        let above = value.filter(|&value| value > 0.0);
        above.ok_or(MissingLimit { joint, limit, zero })
    };
    // Down, so that an error relative to it is rounded up.
    let torque = |joint| Ok(read(joint, "torque", |limits| &limits.torque)?.next_down());
    let velocity = |joint| read(joint, "velocity", |limits| &limits.velocity);
    let acceleration = |joint| read(joint, "acceleration", |limits| &limits.acceleration);
    let inertia = |i, k| Ok((torque(i)? / acceleration(k)?).next_down());
    let rows = &program.rows;
    let mut scales = Vec::new();
    for quantity in program.function.quantities() {
        for &i in rows {
            match quantity {
                Quantity::Torque | Quantity::Coriolis | Quantity::Gravity => {
                    scales.push(torque(i)?);
                }
                Quantity::Inertia => {
                    for &k in rows {
                        let both = [inertia(i, k)?, inertia(k, i)?];
                        scales.push(both[0].min(both[1]));
                    }
                }
                Quantity::Christoffel => {
                    for (&k, &m) in rows.iter().flat_map(|k| rows.iter().map(move |m| (k, m))) {
                        let rates = (velocity(k)? * velocity(m)?).next_up();
                        scales.push((torque(i)? / rates).next_down());
                    }
                }
            }
        }
    }
    Ok(scales)
}

/// The tolerance of each output: that of its joint, for an entry of D the
/// smaller of its two joints'.
pub fn tolerances(program: &Program, tolerance: &Tolerance) -> Vec<f64> {
    let rows = &program.rows;
    // Down: nothing is allowed that the decimal does not allow.
    let of = |joint: usize| {
        let value = tolerance.of(joint).map(f64::nearest_rational);
        value.map_or(0.0, |value| {
            let above = Rational::from_float(value)
                .is_some_and(|exact| tolerance.of(joint).is_some_and(|wanted| exact > *wanted));
            if above { value.next_down() } else { value }
        })
    };
    let mut all = Vec::new();
    for quantity in program.function.quantities() {
        for index in 0..quantity.len(rows.len()) {
            let joints = quantity.indices(index, rows.len()).map(|at| rows[at]);
            all.push(joints.map(of).fold(f64::INFINITY, f64::min));
        }
    }
    all
}

/// A magnitude that each output attains, found by climbing from actual states:
/// its largest over the box or just below, so an error relative to it is not
/// understated.
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
