//! The states for which a bound holds.

use std::fmt;

use dalembert_model::number::{Rational, Rounded};
use dalembert_model::robot::{Joint, JointKind, Position, Robot};

use super::interval::Interval;
use crate::graph::{AngleSum, Input};

/// Intervals of joint positions, velocities and accelerations, one a joint.
#[derive(Clone, Debug, PartialEq)]
pub struct InputBox {
    /// q, rad or m.
    pub position: Vec<Interval>,
    /// q̇
    pub velocity: Vec<Interval>,
    /// q̈
    pub acceleration: Vec<Interval>,
}

/// A limit that a bound needs and the robot does not have.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MissingLimit {
    /// Zero-based joint.
    pub joint: usize,
    /// The key in the robot file.
    pub limit: &'static str,
}

impl fmt::Display for MissingLimit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "a bound needs a box: joint {} has no limit `{}`",
            self.joint + 1,
            self.limit
        )
    }
}

impl std::error::Error for MissingLimit {}

impl InputBox {
    /// The robot's limits. A revolute joint without limits of position may
    /// stand anywhere: one turn.
    ///
    /// # Errors
    /// A limit of motion that the robot does not have.
    pub fn of(robot: &Robot) -> Result<InputBox, MissingLimit> {
        let mut limits = InputBox {
            position: Vec::new(),
            velocity: Vec::new(),
            acceleration: Vec::new(),
        };
        for (joint, row) in robot.joints.iter().enumerate() {
            let missing = |limit| MissingLimit { joint, limit };
            limits
                .position
                .push(position(row).ok_or(missing("position"))?);
            let rate = |limit: &Option<Rational>| {
                let most = f64::nearest_rational(limit.as_ref()?);
                Some(Interval::symmetric(most))
            };
            limits
                .velocity
                .push(rate(&row.limits.velocity).ok_or(missing("velocity"))?);
            limits
                .acceleration
                .push(rate(&row.limits.acceleration).ok_or(missing("acceleration"))?);
        }
        Ok(limits)
    }

    /// The number of joints.
    pub fn joints(&self) -> usize {
        self.position.len()
    }

    /// The values that an angle takes.
    pub fn angle(&self, angle: AngleSum) -> Interval {
        angle
            .terms()
            .fold(Interval::ZERO, |sum, (joint, negative)| {
                let q = self.position[joint];
                match (negative, sum == Interval::ZERO) {
                    (false, true) => q,
                    (true, true) => -q,
                    (false, false) => sum + q,
                    (true, false) => sum - q,
                }
            })
    }

    /// The values that an input takes.
    pub fn input(&self, input: Input) -> Interval {
        match input {
            Input::Sin(angle) => self.angle(angle).sin(),
            Input::Cos(angle) => self.angle(angle).cos(),
            Input::Position(joint) => self.position[joint],
            Input::Velocity(joint) => self.velocity[joint],
            Input::Acceleration(joint) => self.acceleration[joint],
        }
    }
}

fn position(joint: &Joint) -> Option<Interval> {
    let value = |position: &Position| match position {
        Position::Angle(angle) => angle.to_f64(),
        Position::Length(length) => f64::nearest_rational(length),
    };
    match (&joint.limits.position, joint.kind) {
        (Some([low, high]), _) => Interval::new(value(low), value(high)),
        (None, JointKind::Revolute) => Some(Interval::symmetric(std::f64::consts::PI)),
        (None, JointKind::Prismatic) => None,
    }
}
