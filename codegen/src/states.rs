//! Seeded joint states inside a robot's limits.

use dalembert_model::number::Rounded;
use dalembert_model::robot::{Joint, JointKind, Position, Robot};

use crate::random::Random;

/// One value a joint.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct JointState {
    /// Positions, rad or m.
    pub q: Vec<f64>,
    /// Velocities, the same per second.
    pub qd: Vec<f64>,
    /// Accelerations, per second squared.
    pub qdd: Vec<f64>,
}

/// How many states the floating check takes unless told otherwise.
pub const STATES: usize = 200;

/// The seed of the floating check.
pub const SEED: u64 = 0xa1e3;

/// States drawn evenly from the robot's limits; where it has none: ±π, or
/// ±1 m, ±3 per second, ±10 per second squared. The same on every machine.
pub fn seeded(robot: &Robot, count: usize, seed: u64) -> Vec<JointState> {
    let mut random = Random::new(seed);
    let mut draw = |[low, high]: [f64; 2]| low + (high - low) * random.unit();
    // Once, not state by state: a multiple of π is rounded from 120 digits.
    let ranges = robot.joints.iter().map(|joint| {
        let (velocity, acceleration) = (
            rate(&joint.limits.velocity, 3.0),
            rate(&joint.limits.acceleration, 10.0),
        );
        (
            range(joint),
            [-velocity, velocity],
            [-acceleration, acceleration],
        )
    });
    let ranges: Vec<_> = ranges.collect();
    (0..count)
        .map(|_| {
            let mut state = JointState::default();
            for &(position, velocity, acceleration) in &ranges {
                state.q.push(draw(position));
                state.qd.push(draw(velocity));
                state.qdd.push(draw(acceleration));
            }
            state
        })
        .collect()
}

impl JointState {
    /// The nearest f32 state, held in doubles.
    pub fn in_single(&self) -> JointState {
        let single = |values: &[f64]| values.iter().map(|&x| f64::from(x as f32)).collect();
        JointState {
            q: single(&self.q),
            qd: single(&self.qd),
            qdd: single(&self.qdd),
        }
    }
}

fn range(joint: &Joint) -> [f64; 2] {
    let value = |position: &Position| match position {
        Position::Angle(angle) => angle.to_f64(),
        Position::Length(length) => f64::nearest_rational(length),
    };
    match (&joint.limits.position, joint.kind) {
        (Some(limits), _) => limits.each_ref().map(value),
        (None, JointKind::Revolute) => [-core::f64::consts::PI, core::f64::consts::PI],
        (None, JointKind::Prismatic) => [-1.0, 1.0],
    }
}

fn rate(limit: &Option<dalembert_model::number::Rational>, default: f64) -> f64 {
    limit.as_ref().map_or(default, f64::nearest_rational)
}
