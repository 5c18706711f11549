//! The matrix: categories of robots and states, and what each is held to.

use dalembert_model::robot::Robot;

use super::deviation::Deviation;
use super::{robots, states};
use dalembert_codegen::workspace::{JointState, seeded};

/// Errors of a vector above this, in u, fail.
pub const NORMWISE: f64 = 100.0;

/// Errors of a joint above this, in u of what the joint meets, fail.
pub const PER_JOINT: f64 = 50.0;

/// The criterion of a category.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Criterion {
    /// [`NORMWISE`] and [`PER_JOINT`].
    Both,
    /// [`NORMWISE`] only: one joint's loads say nothing about another's.
    Normwise,
    /// [`PER_JOINT`] only: next to zero torque an error relative to the
    /// torque says nothing about the code.
    PerJoint,
}

impl Criterion {
    /// Returns whether an error meets it.
    pub fn met(self, deviation: &Deviation) -> bool {
        self.excess(deviation) <= 1.0
    }

    /// Returns the error in parts of what is allowed; NaN counts as infinite.
    pub fn excess(self, deviation: &Deviation) -> f64 {
        let part = |error: f64, bound: f64| match error / bound {
            part if part.is_nan() => f64::INFINITY,
            part => part,
        };
        let normwise = part(deviation.normwise, NORMWISE);
        let per_joint = part(deviation.per_joint, PER_JOINT);
        match self {
            Criterion::Both => normwise.max(per_joint),
            Criterion::Normwise => normwise,
            Criterion::PerJoint => per_joint,
        }
    }
}

/// A robot made out of a robot, `None` if this one has no such thing.
type Change = fn(&Robot) -> Option<Robot>;

/// So many states of a robot, from a seed.
type Draw = fn(&Robot, usize, u64) -> Vec<JointState>;

/// One category.
#[derive(Clone, Copy, Debug)]
pub struct Category {
    /// Its name in reports.
    pub name: &'static str,
    /// The criterion that it is held to.
    pub criterion: Criterion,
    /// The robot, if another.
    robot: Option<Change>,
    /// States to test at.
    states: Draw,
    /// States to take the torque scales from, if others.
    scales: Option<Draw>,
}

impl Category {
    /// Returns the robot to test: its own program is needed where it is another.
    pub fn robot(&self, robot: &Robot) -> Option<Robot> {
        match self.robot {
            Some(change) => change(robot),
            None => Some(robot.clone()),
        }
    }

    /// Returns whether it is the user's robot itself.
    pub fn same_robot(&self) -> bool {
        self.robot.is_none()
    }

    /// States to test at.
    pub fn states(&self, robot: &Robot, count: usize, seed: u64) -> Vec<JointState> {
        (self.states)(robot, count, seed)
    }

    /// States to take the torque scales from.
    pub fn scale_states(&self, robot: &Robot, count: usize, seed: u64) -> Vec<JointState> {
        self.scales.unwrap_or(self.states)(robot, count, seed)
    }

    /// Returns every category.
    pub fn all() -> Vec<Category> {
        use Criterion::*;
        let here = |name, criterion, states| Category {
            name,
            criterion,
            robot: None,
            states,
            scales: None,
        };
        let other = |name, criterion, robot| Category {
            robot: Some(robot),
            ..here(name, criterion, seeded)
        };
        vec![
            here("normal", Both, seeded),
            here("angles 1e2", Both, |r, n, s| states::angles(r, n, s, 1e2)),
            here("angles 1e4", Both, |r, n, s| states::angles(r, n, s, 1e4)),
            here("angles 1e6", Both, |r, n, s| states::angles(r, n, s, 1e6)),
            here("angles 1e8", Both, |r, n, s| states::angles(r, n, s, 1e8)),
            here("velocities 1e3", Both, |r, n, s| {
                states::times(r, n, s, [1.0, 1e3, 1.0])
            }),
            here("velocities 1e6", Both, |r, n, s| {
                states::times(r, n, s, [1.0, 1e6, 1.0])
            }),
            here("accelerations 1e6", Both, |r, n, s| {
                states::times(r, n, s, [1.0, 1.0, 1e6])
            }),
            here("wrist singular", Both, states::wrist),
            here("stretched", Both, states::stretched),
            here("tiny", PerJoint, |r, n, s| {
                states::times(r, n, s, [1e-8; 3])
            }),
            Category {
                robot: Some(|r| Some(robots::weightless(r))),
                ..here("tiny rates, no gravity", PerJoint, |r, n, s| {
                    states::times(r, n, s, [1.0, 1e-8, 1e-8])
                })
            },
            Category {
                scales: Some(states::still),
                ..here("static near balance", PerJoint, states::balanced)
            },
            other("mass ratio 1e-9", Normwise, |r| {
                Some(robots::mass_ratio(r, -9))
            }),
            other("mass ratio 1e-3", Normwise, |r| {
                Some(robots::mass_ratio(r, -3))
            }),
            other("mass ratio 1e3", Normwise, |r| {
                Some(robots::mass_ratio(r, 3))
            }),
            other("mass ratio 1e9", Normwise, |r| {
                Some(robots::mass_ratio(r, 9))
            }),
            other("lengths 1e-6", Normwise, |r| Some(robots::lengths(r, -6))),
            other("lengths 1e6", Normwise, |r| Some(robots::lengths(r, 6))),
            other("lengths mixed, long hand", Normwise, |r| {
                Some(robots::mixed_lengths(r, true))
            }),
            other("lengths mixed, long base", Normwise, |r| {
                Some(robots::mixed_lengths(r, false))
            }),
            other("massless last link", Both, |r| Some(robots::massless(r, 1))),
            other("massless wrist", Both, |r| {
                (r.joints.len() > 3).then(|| robots::massless(r, 3))
            }),
            other("point mass at the tip", PerJoint, |r| {
                Some(robots::point_mass(r))
            }),
            other("payload 1 kg", Both, |r| Some(robots::payload(r, 0))),
            other("payload 1e3 kg", Both, |r| Some(robots::payload(r, 3))),
            other("payload 1e6 kg", Both, |r| Some(robots::payload(r, 6))),
            other("base offset 1e6 m", Both, |r| {
                Some(robots::base_offset(r, 6))
            }),
            other("a million turns of offset", Both, robots::huge_offset),
            other("right angles as 1.5708", Both, robots::typed_angles),
            other("chain of 20 joints", Normwise, |r| {
                (r.joints.len() < 20).then(|| robots::repeated(r, 20))
            }),
        ]
    }
}
