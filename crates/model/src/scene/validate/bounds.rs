//! The box: a range for every joint, none of them empty, and somewhere where the joint can be. One
//! that goes beyond the limits is only odd: a bound over more than is needed is a bound.

use alloc::format;
use alloc::vec::Vec;

use num_traits::Signed;

use super::Check;
use crate::robot::{Limit, Position, RobotWarning, shown};

const BEYOND: &str = "bounds hold over the whole range; taken as it stands";

impl Check<'_> {
    pub(super) fn bounds(&mut self) {
        let n = self.robot.joints.len();
        let (bounds, rates) = (&self.scene.bounds, self.base() + n);
        let length = |rate: Limit| bounds.rate(rate).map(Vec::len);
        for (key, length, expected) in [
            ("position", bounds.position.as_ref().map(Vec::len), n),
            ("velocity", length(Limit::Velocity), rates),
            ("acceleration", length(Limit::Acceleration), rates),
        ] {
            if let Some(length) = length.filter(|&length| length != expected) {
                let (has, help) = match expected == n {
                    true => (format!("{n} joints"), "one entry a joint"),
                    false => (
                        format!("a base that floats and {n} joints"),
                        "six entries of the base, linear over angular in its axes, then one a joint",
                    ),
                };
                let message = format!("{length} entries, but the robot has {has}");
                self.error(format!("box/{key}"), message, help);
            }
        }
        for (index, range) in bounds.position.iter().flatten().enumerate() {
            self.positions(index, range);
        }
        self.rates(Limit::Velocity);
        self.rates(Limit::Acceleration);
        let payload = self.place("box/payload");
        self.found.bodies(payload, &bounds.payload);
    }

    fn positions(&mut self, index: usize, [low, high]: &[Position; 2]) {
        let Some(joint) = self.joint(index) else {
            return;
        };
        let place = format!("box/position/#{}", index + 1);
        if !low.is_of(joint.kind) || !high.is_of(joint.kind) {
            let help = "angles for a revolute joint, lengths for a prismatic one";
            return self.error(place, "the range has the wrong unit", help);
        }
        if !low.is_below(high) {
            let message = "the range is empty: its lowest position is not below its highest";
            let help = "write [lowest, highest]; a joint that does not move is locked";
            return self.error(place, message, help);
        }
        let Some([lowest, highest]) = &joint.limits.position else {
            return;
        };
        if self.scene.locked(index).is_some() {
            return;
        }
        let name = self.robot.joint_label(index);
        let limits = format!("{lowest} to {highest}");
        if high.is_below(lowest) || highest.is_below(low) {
            let message = format!("{name} is never in this range: its limits are {limits}");
            let help = "give a range within the joint's limits";
            self.error(place, message, help);
        } else if low.is_below(lowest) || highest.is_below(high) {
            let scene = &self.scene.name;
            let message =
                format!("the box of scene `{scene}` goes beyond the limits of {name}, {limits}");
            self.warn(RobotWarning::BoxBeyondLimits, place, message, BEYOND);
        }
    }

    /// Zero is a range too: at rest.
    fn rates(&mut self, rate: Limit) {
        let values = self.scene.bounds.rate(rate);
        for (index, value) in values.into_iter().flatten().enumerate() {
            let key = rate.key();
            let place = format!("box/{key}/#{}", index + 1);
            if value.is_negative() {
                let message = format!("the range is empty: the {key} is negative");
                let help = "the largest size, in both directions: zero or more";
                self.error(place, message, help);
                continue;
            }
            // Nothing of a base that is locked is in the list.
            let index = index + self.robot.base_coordinates() - self.base();
            let joint = self.robot.joint_of(index);
            let is_locked = joint.is_some_and(|joint| self.scene.locked(joint).is_some());
            let limit = self.robot.limit_of(index, rate);
            if let Some(limit) = limit.filter(|limit| value > limit && !is_locked) {
                let (scene, name) = (&self.scene.name, self.robot.coordinate_label(index));
                let limit = shown(limit);
                let message = format!(
                    "the box of scene `{scene}` goes beyond the {key} limit of {name}, {limit}"
                );
                self.warn(RobotWarning::BoxBeyondLimits, place, message, BEYOND);
            }
        }
    }
}
