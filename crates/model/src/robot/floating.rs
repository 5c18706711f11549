//! A base that floats: the first joint of a robot file, of kind `floating`.

use alloc::format;
use alloc::string::String;

use super::findings::{Findings, of_base};
use super::{BodyRange, Inertia, Joint, JointKind, Limit, Robot};
use crate::number::Rational;

/// The body of a base that floats, with its limits. It moves in six coordinates, which come before
/// those of the joints wherever something has an entry a coordinate.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct FloatingBase {
    /// Name, if the file gives one.
    pub name: Option<String>,
    /// Mass, kg.
    pub mass: Rational,
    /// Centre of mass in the base's frame, m.
    pub com: [Rational; 3],
    /// Inertia tensor about the centre of mass in the base's axes, kg·m².
    pub inertia: Inertia<Rational>,
    /// Limits of its motion, and of the wrench on it.
    pub limits: BaseLimits,
}

/// Limits of a base that floats: of each coordinate, linear over angular in its axes.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct BaseLimits {
    /// Largest size of each component of (v, ω), m/s and rad/s.
    pub velocity: Option<[Rational; 6]>,
    /// Largest size of each component of their rates, m/s² and rad/s².
    pub acceleration: Option<[Rational; 6]>,
    /// Largest size of each component of the wrench, N and N·m.
    pub torque: Option<[Rational; 6]>,
    /// The bodies of the base, where they are an argument.
    pub body: Option<BodyRange>,
}

impl BaseLimits {
    /// Returns a limit; none of positions.
    pub fn rate(&self, rate: Limit) -> Option<&[Rational; 6]> {
        match rate {
            Limit::Position => None,
            Limit::Velocity => self.velocity.as_ref(),
            Limit::Acceleration => self.acceleration.as_ref(),
            Limit::Torque => self.torque.as_ref(),
        }
    }
}

impl FloatingBase {
    /// The word by which robot files name the kind.
    pub const KIND: &'static str = "floating";
    /// The number of its coordinates.
    pub const COORDINATES: usize = 6;

    /// Returns a joint with its name and body, which has no place and no limits.
    pub fn body(&self) -> Joint {
        Joint {
            name: self.name.clone(),
            mass: self.mass.clone(),
            com: self.com.clone(),
            inertia: self.inertia.clone(),
            ..Joint::default()
        }
    }
}

impl Robot {
    /// Returns how many coordinates are those of a base that floats: six, or none.
    pub fn base_coordinates(&self) -> usize {
        let base = self.floating.as_ref();
        base.map_or(0, |_| FloatingBase::COORDINATES)
    }

    /// Returns the number of coordinates of its velocity: those of a floating base and of joints.
    pub fn coordinates(&self) -> usize {
        self.base_coordinates() + self.joints.len()
    }

    /// Returns the joint that is a coordinate of the velocity, both zero-based; `None` of a base's.
    pub fn joint_of(&self, coordinate: usize) -> Option<usize> {
        coordinate.checked_sub(self.base_coordinates())
    }

    /// Returns a coordinate's name in messages: `the base's ω_y`, or a [joint's](Robot::joint_label).
    pub fn coordinate_label(&self, coordinate: usize) -> String {
        const OF_BASE: [&str; 6] = ["v_x", "v_y", "v_z", "ω_x", "ω_y", "ω_z"];
        match self.joint_of(coordinate) {
            None => format!("the base's {}", OF_BASE[coordinate]),
            Some(joint) => self.joint_label(joint),
        }
    }

    /// Returns the limit of a rate, or of the load, of a coordinate: of a joint, or of the base.
    pub fn limit_of(&self, coordinate: usize, rate: Limit) -> Option<&Rational> {
        match self.joint_of(coordinate) {
            Some(joint) => self.joints.get(joint)?.limits.rate(rate),
            None => self.floating.as_ref()?.limits.rate(rate)?.get(coordinate),
        }
    }

    /// Returns true if a coordinate is an angle, or the rate of a turn.
    pub fn turns(&self, coordinate: usize) -> bool {
        match self.joint_of(coordinate) {
            None => coordinate >= 3,
            Some(joint) => (self.joints.get(joint)).is_some_and(|j| j.kind == JointKind::Revolute),
        }
    }

    /// True if its joints are placed, and it has no hand: its links branch, or its base floats.
    pub fn is_tree(&self) -> bool {
        self.floating.is_some() || self.branches()
    }

    /// Returns every body that moves, with its label: the base, if it floats, then the links.
    pub fn bodies(&self) -> impl Iterator<Item = Joint> + '_ {
        let base = self.floating.iter().map(FloatingBase::body);
        base.chain(self.rows().into_iter().cloned())
    }
}

impl Findings {
    pub(super) fn floating(&mut self, robot: &Robot) {
        let Some(base) = &robot.floating else {
            return;
        };
        if let Some(name) = &base.name {
            self.joint_name(0, name);
        }
        self.inertial(&of_base, &base.body());
        for rate in [Limit::Velocity, Limit::Acceleration, Limit::Torque] {
            for limit in base.limits.rate(rate).into_iter().flatten() {
                self.not_negative(&of_base(&format!("limits/{}", rate.key())), limit);
            }
        }
        self.bodies(of_base("limits/body"), &base.limits.body);
        let placements = robot.placements().into_iter();
        for (key, _) in placements.filter(|(_, placement)| placement.is_some()) {
            let message = format!("`{key}` of a robot whose base floats");
            let help =
                "where the base is has no effect; a [[frame]] with a `link` is a foot or a hand";
            self.error(key, message, help);
        }
    }
}
