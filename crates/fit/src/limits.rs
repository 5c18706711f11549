//! Limits of positions and rates of joints.

use dalembert_model::number::{Rational, Rounded};
use dalembert_model::robot::{JointKind, Position, Robot};

/// The limits of a joint's motion, in rad or m and seconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Lowest and highest position.
    pub position: [f64; 2],
    /// Largest |q̇|.
    pub velocity: f64,
    /// Largest |q̈|.
    pub acceleration: f64,
}

impl Limits {
    /// Reads the limits of every joint of a robot. Where the file has none: ±π or ±0.5 m,
    /// 2 rad/s or 0.5 m/s, 10 rad/s² or 2 m/s².
    pub fn of(robot: &Robot) -> Vec<Limits> {
        let or = |limit: &Option<Rational>, usual: f64| {
            limit.as_ref().map_or(usual, f64::nearest_rational)
        };
        let joint_limits = robot.joints.iter().map(|joint| {
            let [reach, velocity, acceleration] = match joint.kind {
                JointKind::Revolute => [core::f64::consts::PI, 2.0, 10.0],
                JointKind::Prismatic => [0.5, 0.5, 2.0],
            };
            let limits = &joint.limits;
            Limits {
                position: match &limits.position {
                    Some(ends) => ends.each_ref().map(Position::to_f64),
                    None => [-reach, reach],
                },
                velocity: or(&limits.velocity, velocity),
                acceleration: or(&limits.acceleration, acceleration),
            }
        });
        joint_limits.collect()
    }

    /// Reads the limits of each coordinate of a base that floats, which has no positions; none of a fixed
    /// base. Where the file has none: 1 m/s, 2 rad/s, 5 m/s², 10 rad/s².
    pub fn of_base(robot: &Robot) -> Vec<Limits> {
        let base = robot.floating.as_ref().map(|base| {
            let number = |limits: &Option<[Rational; 6]>, k: usize, usual: [f64; 2]| {
                let limit = limits.as_ref().map(|limits| &limits[k]);
                limit.map_or(usual[usize::from(k >= 3)], f64::nearest_rational)
            };
            [0, 1, 2, 3, 4, 5].map(|k| Limits {
                position: [0.0; 2],
                velocity: number(&base.limits.velocity, k, [1.0, 2.0]),
                acceleration: number(&base.limits.acceleration, k, [5.0, 10.0]),
            })
        });
        base.into_iter().flatten().collect()
    }

    pub(crate) fn moves(&self) -> bool {
        let limits = [self.reach(), self.velocity, self.acceleration];
        limits.iter().all(|limit| *limit > 0.0 && limit.is_finite())
    }

    /// Returns the middle of the range of positions.
    pub fn middle(&self) -> f64 {
        0.5 * (self.position[0] + self.position[1])
    }

    /// Returns half the range of positions.
    pub fn reach(&self) -> f64 {
        0.5 * (self.position[1] - self.position[0])
    }
}
