//! T: what errors are relative to, and how large they may be against it.

use dalembert_checker::certify::BodyRange;
use dalembert_model::diagnostic::Diagnostic;
use dalembert_model::number::{Rational, Rounded};
use dalembert_model::robot::{Limit, Robot};
use dalembert_model::scene::Tolerance;

use super::input_box::{InputBox, missing};
use super::sample::{climb, draw};
use crate::function::ErrorScale;
use crate::program::Program;
use crate::random::Random;
use crate::states::JointState;

/// The points that a payload is put to, after each climb, and how far they stay inside its radius.
const POINTS: usize = 40;
const INSIDE: f64 = 1.0 - 1e-9;

/// Returns the torque limits of the actuators. For an entry of D the inertia, for one
/// of h_ikm the coefficient, that alone takes the whole limit at the largest
/// rates, of the smaller of D_ik and D_ki: then D's scales are symmetric. So limits are above
/// zero here, where a box may have rates of zero.
///
/// # Errors
/// A joint without a limit that it needs, or with one of zero; a quantity of which torque limits
/// are no measure.
pub(crate) fn actuator(robot: &Robot, program: &Program) -> Result<Vec<f64>, Diagnostic> {
    let read = |coordinate: usize, limit: Limit| {
        let joint = robot.joint_of(coordinate);
        match robot.limit_of(coordinate, limit).map(f64::nearest_rational) {
            Some(value) if value > 0.0 => Ok(value),
            Some(_) => Err(Diagnostic::error(format!(
                "the limit `{}` of {} is 0: errors relative to the actuators need \
                 a limit above 0: set it, or make them relative to the range",
                limit.key(),
                joint.map_or_else(
                    || robot.coordinate_label(coordinate),
                    |joint| format!("joint {}", joint + 1)
                )
            ))),
            None => Err(missing([(limit.key(), vec![joint])])),
        }
    };
    // Down, so that an error relative to it is rounded up.
    let torque = |joint| read(joint, Limit::Torque).map(f64::next_down);
    let velocity = |joint| read(joint, Limit::Velocity);
    let acceleration = |joint| read(joint, Limit::Acceleration);
    let inertia = |i, k| Ok::<f64, Diagnostic>((torque(i)? / acceleration(k)?).next_down());
    let (rows, sizes) = (&program.rows, program.sizes());
    let mut scales = Vec::new();
    for quantity in program.function.quantities() {
        for index in 0..quantity.len(sizes) {
            let joints: Vec<usize> = quantity.coordinates(index, rows, sizes).collect();
            scales.push(match (quantity.facts().scale, joints.as_slice()) {
                (ErrorScale::Load, &[i]) => torque(i)?,
                (ErrorScale::Inertia, &[i, k]) => inertia(i, k)?.min(inertia(k, i)?),
                (ErrorScale::Coefficient, &[i, k, m]) => {
                    let rates = (velocity(k)? * velocity(m)?).next_up();
                    (torque(i)? / rates).next_down()
                }
                _ => {
                    return Err(Diagnostic::error(format!(
                        "the actuators' limits are no measure of {}: make its errors relative to \
                         the range",
                        quantity.symbol()
                    )));
                }
            });
        }
    }
    Ok(scales)
}

/// An entry of D has the smaller one of its two joints'.
pub(crate) fn tolerances(program: &Program, tolerance: &Tolerance) -> Vec<f64> {
    let (rows, sizes) = (&program.rows, program.sizes());
    // Down: nothing is allowed that the decimal does not allow.
    let down = |wanted: &Rational| {
        let value = f64::nearest_rational(wanted);
        let is_above = Rational::from_float(value).is_some_and(|exact| exact > *wanted);
        if is_above { value.next_down() } else { value }
    };
    let of = |joint: usize| tolerance.of(joint).map_or(0.0, down);
    // A result of no joint, such as an energy, is held to the strictest.
    let strictest = rows.iter().copied().map(of).reduce(f64::min);
    let mut tolerances = Vec::new();
    for quantity in program.function.quantities() {
        for index in 0..quantity.len(sizes) {
            let allowances = quantity.coordinates(index, rows, sizes).map(of);
            tolerances.push(allowances.reduce(f64::min).or(strictest).unwrap_or(0.0));
        }
    }
    tolerances
}

/// Returns a magnitude that each output attains, by climbing from actual states: its largest over the
/// box or just below, so that no error relative to it is understated; and the state, at which the
/// checker finds T.
///
/// A payload is a point of the largest mass: results are linear in its moments of all degrees, and all
/// bodies are between such points.
pub fn range(exact: &Program, load: Option<&Program>, limits: &InputBox) -> Vec<(f64, JointState)> {
    let (code, load) = (exact.in_doubles(), load.map(Program::in_doubles));
    let put = |state: &mut JointState, random: &mut Random| {
        if let (Some(load), Some(BodyRange { mass, radius })) = (&load, limits.payload) {
            let at = [(); 3].map(|()| 2.0 * random.unit() - 1.0);
            let length = at.iter().map(|x| x * x).sum::<f64>().sqrt().max(0.1);
            let point = at.map(|x| INSIDE * radius * x / length);
            state.payload = [&[mass[1]][..], &point, &[0.0; 6]].concat();
            state.load = load.run_at(state);
        }
    };
    let mut random = Random::new(0x7a46e);
    let outputs = 0..exact.dag.outputs.len();
    let ranges = outputs.map(|output| {
        let mut size = |state: &JointState| code.run_at(state)[output].abs();
        let (mut most, mut at) = (0.0f64, JointState::default());
        for climbed in 0..12 {
            let mut from = draw(limits, &mut random);
            put(&mut from, &mut random);
            let (mut state, mut magnitude) = climb(limits, from, 1500, &mut random, &mut size);
            for _ in 0..limits.payload.map_or(0, |_| POINTS) {
                let mut next = state.clone();
                put(&mut next, &mut random);
                let candidate = size(&next);
                if candidate > magnitude {
                    (state, magnitude) = (next, candidate);
                }
            }
            if magnitude > most || climbed == 0 {
                (most, at) = (magnitude, state);
            }
        }
        (most, at)
    });
    ranges.collect()
}
