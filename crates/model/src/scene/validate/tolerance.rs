//! The tolerance, and what it needs of the robot: a box, and limits of torque as its scale.

use alloc::borrow::ToOwned;
use alloc::format;
use alloc::string::String;

use num_traits::{One, Signed, Zero};

use super::Check;
use crate::number::Rational;
use crate::outputs::{Argument, ErrorScale, Function};
use crate::robot::{JointKind, Limit, RobotWarning};
use crate::scene::Scale;

impl Check<'_> {
    pub(super) fn tolerance(&mut self) {
        let Some(tolerance) = &self.scene.tolerance else {
            return;
        };
        let (n, count) = (self.robot.joints.len(), tolerance.value.len());
        if count != 1 && count != self.base() + n {
            let (has, help) = match self.base() {
                0 => (format!("{n} joints"), "one for all joints, or one a joint"),
                _ => (
                    format!("a base that floats and {n} joints"),
                    "one for all, or six of the base, linear over angular, then one a joint",
                ),
            };
            let message = format!("{count} tolerances, but the robot has {has}");
            self.error("tolerance", message, help);
        }
        for (index, value) in tolerance.value.iter().enumerate() {
            if !value.is_positive() {
                let help = "without a tolerance the code is exact up to rounding";
                self.error(self.of_value(index), "a tolerance must be above zero", help);
            }
        }
        let mut values = tolerance.value.iter();
        if let Some(index) = values.position(|value| *value >= Rational::one()) {
            let message = "a tolerance of 1 or more allows an error as large as the output";
            let help = "it is a fraction of the reference: 0.01 for 1%";
            let (warning, place) = (RobotWarning::LooseTolerance, self.of_value(index));
            self.warn(warning, place, message.into(), help);
        }
        self.needs(tolerance.relative_to);
    }

    fn of_value(&self, index: usize) -> String {
        match &self.scene.tolerance {
            Some(tolerance) if tolerance.value.len() > 1 => {
                format!("tolerance/value/#{}", index + 1)
            }
            _ => "tolerance/value".into(),
        }
    }

    /// True also if the scene leaves its outputs to the request.
    fn may_read(&self, argument: Argument) -> bool {
        let outputs = &self.scene.outputs;
        outputs.is_empty() || outputs.iter().any(|f| f.arguments().contains(&argument))
    }

    fn is_scaled(&self, by: ErrorScale) -> bool {
        let scaled = |f: &Function| f.quantities().iter().any(|q| q.facts().scale == by);
        self.scene.outputs.iter().any(scaled)
    }

    /// Limits of the scale T must be above zero, for every joint with a result.
    fn needs(&mut self, scale: Scale) {
        let scene = self.scene;
        let robot = scene.apply(self.robot);
        let joints = scene.rows(robot.joints.len());
        let velocity = !scene.velocity_zero && self.may_read(Argument::Velocity);
        let acceleration = !scene.acceleration_zero && self.may_read(Argument::Acceleration);
        // The generator checks functions that the request alone names.
        let inertia = self.is_scaled(ErrorScale::Inertia);
        let coefficients = self.is_scaled(ErrorScale::Coefficient);
        for coordinate in 0..robot.coordinates() {
            let joint = robot.joint_of(coordinate);
            if joint.is_none_or(|joint| scene.locked(joint).is_none()) {
                // The sines and cosines of an angle are bounded anyway.
                let free = joint.map(|joint| &robot.joints[joint]).filter(|joint| {
                    joint.kind == JointKind::Prismatic && joint.limits.position.is_none()
                });
                self.range(coordinate, "position", free.is_some());
                for (rate, is_read) in [
                    (Limit::Velocity, velocity),
                    (Limit::Acceleration, acceleration),
                ] {
                    let lacks = is_read && robot.limit_of(coordinate, rate).is_none();
                    self.range(coordinate, rate.key(), lacks);
                }
            }
            let has_result = joint.is_none_or(|joint| joints.contains(&joint));
            if scale != Scale::Actuator || !has_result {
                continue;
            }
            for (rate, of, is_needed) in [
                (Limit::Torque, "", true),
                (Limit::Acceleration, " of D", inertia),
                (Limit::Velocity, " of h_ikm", coefficients),
            ] {
                if is_needed {
                    self.above_zero(coordinate, rate, of, robot.limit_of(coordinate, rate));
                }
            }
        }
    }

    /// The label of a coordinate in the scene, all six of a base at once, and the file's word for it.
    fn label(&self, coordinate: usize) -> (String, &'static str) {
        match coordinate.checked_sub(self.base()) {
            Some(joint) => (self.robot.joint_label(joint), "joint"),
            None => ("the base".to_owned(), "base"),
        }
    }

    fn range(&mut self, coordinate: usize, what: &str, lacks: bool) {
        // One message is enough for the six coordinates of a base.
        let is_repeated = (1..self.base()).contains(&coordinate);
        if lacks && !is_repeated {
            let (name, owner) = self.label(coordinate);
            let message = format!("a tolerance needs the range of the {what} of {name}");
            let help = format!("give `{what}` in the scene's box or in the {owner}'s limits");
            self.error("tolerance", message, &help);
        }
    }

    fn above_zero(&mut self, coordinate: usize, rate: Limit, of: &str, limit: Option<&Rational>) {
        let ((name, owner), what) = (self.label(coordinate), rate.key());
        match limit {
            None if (1..self.base()).contains(&coordinate) => {}
            None => {
                let message = format!(
                    "a tolerance{of} relative to the actuator needs the {what} limit of {name}"
                );
                let help =
                    format!("give `{what}` in the {owner}'s limits, or relative_to = \"range\"");
                self.error("tolerance", message, &help);
            }
            Some(limit) if limit.is_zero() => {
                let place = match self.scene.bounds.rate(rate).is_some() {
                    true => self.place(format_args!("box/{what}/#{}", coordinate + 1)),
                    false => {
                        let joint = coordinate.checked_sub(self.base());
                        let row = joint.map_or(0, |joint| self.robot.row_of(joint) + 1);
                        format!("joint/#{row}/limits/{what}")
                    }
                };
                let message = format!(
                    "the {what} limit of {name} is 0, but the tolerance{of} of scene `{}` is \
                     relative to the actuator",
                    self.scene.name
                );
                let help = format!("give a {what} above 0, or relative_to = \"range\"");
                self.found.error(place, message, &help);
            }
            Some(_) => {}
        }
    }
}
