//! Seeded states of given magnitudes, and the torques to be met there: what an
//! error of one joint is measured against.

use dalembert_model::reference::Reference;
use dalembert_model::robot::Robot;
use nalgebra::DVector;

use dalembert_codegen::workspace::{JointState, Random};

/// Number of states that the torque scales are taken over.
pub const STATES: usize = 1000;

/// The seed of the torque scales.
pub const SEED: u64 = 0x7a11;

/// Returns, for each joint, the bounds of |q|, |q̇| and |q̈|: the largest that occur in the state
/// at a joint of its kind.
pub fn magnitudes(robot: &Robot, state: &JointState) -> JointState {
    let of = |values: &[f64]| {
        let largest = |kind| {
            let same = robot
                .joints
                .iter()
                .zip(values)
                .filter(|(j, _)| j.kind == kind);
            same.fold(0.0f64, |most, (_, x)| most.max(x.abs()))
        };
        let joints = robot.joints.iter().take(values.len());
        joints.map(|joint| largest(joint.kind)).collect()
    };
    JointState::new(|argument| of(state.of(argument)))
}

/// States drawn evenly within bounds; the same on every machine.
pub fn draw(bounds: &JointState, count: usize, seed: u64) -> Vec<JointState> {
    let mut random = Random::new(seed);
    let mut within = |bounds: &[f64]| -> Vec<f64> {
        bounds
            .iter()
            .map(|b| b * (2.0 * random.unit() - 1.0))
            .collect()
    };
    (0..count)
        .map(|_| JointState::new(|argument| within(bounds.of(argument))))
        .collect()
}

/// Returns T_i: the largest |τ_i| over states, [`STATES`] of them as a rule.
///
/// An arm that stands still may load a joint with nothing at all, whatever its
/// position: a vertical axis feels no gravity. What is computed there is the
/// dust of a cancellation, and so would be its scale. Such a joint is measured
/// against what it meets at unit rates.
pub fn torques(robot: &Robot, states: &[JointState]) -> Vec<f64> {
    let largest = largest(robot, states.iter());
    let mut rates = states.iter().flat_map(|s| s.qd.iter().chain(&s.qdd));
    if rates.any(|rate| *rate != 0.0) {
        return largest;
    }
    let mut random = Random::new(SEED);
    let moving: Vec<JointState> = states
        .iter()
        .map(|state| {
            let mut rates = || state.q.iter().map(|_| 2.0 * random.unit() - 1.0).collect();
            JointState {
                q: state.q.clone(),
                qd: rates(),
                qdd: rates(),
                ..JointState::default()
            }
        })
        .collect();
    let dust = DUST * largest.iter().copied().fold(0.0, f64::max);
    let moving = self::largest(robot, moving.iter());
    let pairs = largest.iter().zip(moving);
    pairs
        .map(|(&still, moving)| if still > dust { still } else { moving })
        .collect()
}

/// Below this part of the largest torque a torque may be nothing but rounding.
const DUST: f64 = 1e-13;

fn largest<'a>(robot: &Robot, states: impl Iterator<Item = &'a JointState>) -> Vec<f64> {
    let runtime = Reference::<f64>::from_robot(robot);
    let mut largest = vec![0.0f64; robot.joints.len()];
    for state in states {
        let [q, qd, qdd] = [&state.q, &state.qd, &state.qdd].map(|x| DVector::from_column_slice(x));
        // The lengths are the robot's.
        let Ok(tau) = runtime.inverse_dynamics(&q, &qd, &qdd) else {
            continue;
        };
        for (largest, tau) in largest.iter_mut().zip(tau.iter()) {
            *largest = largest.max(tau.abs());
        }
    }
    largest
}
