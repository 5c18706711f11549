//! The tolerance, and what it needs of the robot: a box, and limits of torque
//! if these are what it is relative to.

use alloc::borrow::ToOwned;
use alloc::format;

use num_traits::{One, Signed, Zero};

use super::{Check, Part};
use crate::number::Rational;
use crate::outputs::{Argument, ErrorScale, Function};
use crate::robot::{Field, JointKind, RobotWarning};
use crate::scene::Scale;

impl Check<'_> {
    pub(super) fn tolerance(&mut self) {
        let Some(tolerance) = &self.scene.tolerance else {
            return;
        };
        let (n, found) = (self.robot.joints.len(), tolerance.value.len());
        if found != 1 && found != n {
            let message = format!("{found} tolerances, but the robot has {n} joints");
            let help = "one for all joints, or one a joint";
            self.say(Part::Tolerance(usize::MAX), message, help);
        }
        for (index, value) in tolerance.value.iter().enumerate() {
            if !value.is_positive() {
                let message = "a tolerance is above zero".to_owned();
                let help = "without a tolerance the code is exact up to rounding";
                self.say(Part::Tolerance(index), message, help);
            }
        }
        if let Some(index) = tolerance
            .value
            .iter()
            .position(|value| *value >= Rational::one())
        {
            let message =
                "a tolerance of 1 or more allows an error as large as the output".to_owned();
            let help = "it is a part of what it is relative to: 0.01 for 1%";
            self.warn(
                RobotWarning::LooseTolerance,
                Part::Tolerance(index),
                message,
                help,
            );
        }
        self.needs(tolerance.relative_to);
    }

    /// Returns whether the scene asks for a function that reads this, or leaves
    /// its outputs to the request.
    fn reads(&self, argument: Argument) -> bool {
        let outputs = &self.scene.outputs;
        outputs.is_empty() || outputs.iter().any(|f| f.arguments().contains(&argument))
    }

    /// Returns whether the scene asks by name for a function with such a scale.
    fn is_scaled(&self, by: ErrorScale) -> bool {
        let scaled = |f: &Function| f.quantities().iter().any(|q| q.scale() == by);
        self.scene.outputs.iter().any(scaled)
    }

    /// Reports what a bound needs and nobody says, and what T is made of:
    /// limits above zero, of every joint with a result.
    fn needs(&mut self, scale: Scale) {
        let scene = self.scene;
        // With the box as its limits.
        let robot = scene.apply(self.robot);
        let rows = scene.rows(robot.joints.len());
        let velocity = !scene.velocity_zero && self.reads(Argument::Velocity);
        let acceleration = !scene.acceleration_zero && self.reads(Argument::Acceleration);
        // Functions that only the request names are generation's to judge.
        let inertia = self.is_scaled(ErrorScale::Inertia);
        let coefficients = self.is_scaled(ErrorScale::Coefficient);
        for (index, joint) in robot.joints.iter().enumerate() {
            let limits = &joint.limits;
            if scene.locked(index).is_none() {
                // The sines and cosines of an angle are bounded anyway.
                let slides = joint.kind == JointKind::Prismatic;
                self.range(index, "position", slides && limits.position.is_none());
                self.range(index, "velocity", velocity && limits.velocity.is_none());
                let lacks = acceleration && limits.acceleration.is_none();
                self.range(index, "acceleration", lacks);
            }
            if scale != Scale::Actuator || !rows.contains(&index) {
                continue;
            }
            self.above_zero(index, Field::Torque, limits.torque.as_ref());
            if inertia {
                self.above_zero(index, Field::Acceleration, limits.acceleration.as_ref());
            }
            if coefficients {
                self.above_zero(index, Field::Velocity, limits.velocity.as_ref());
            }
        }
    }

    fn range(&mut self, joint: usize, what: &str, lacks: bool) {
        if lacks {
            let name = self.called(joint);
            let message = format!("a tolerance needs the range of the {what} of joint {name}");
            let help = format!("give `{what}` in the scene's box or in the joint's limits");
            self.say(Part::Tolerance(usize::MAX), message, &help);
        }
    }

    fn above_zero(&mut self, joint: usize, field: Field, limit: Option<&Rational>) {
        let name = self.called(joint);
        let (what, of) = match field {
            Field::Torque => ("torque", ""),
            Field::Acceleration => ("acceleration", " of D"),
            _ => ("velocity", " of h_ikm"),
        };
        match limit {
            None => {
                let message = format!(
                    "a tolerance{of} relative to the actuator needs the {what} limit of joint {name}"
                );
                let help =
                    format!("give `{what}` in the joint's limits, or relative_to = \"range\"");
                self.say(Part::Tolerance(usize::MAX), message, &help);
            }
            Some(limit) if limit.is_zero() => {
                let bounds = &self.scene.bounds;
                let in_box = match field {
                    Field::Velocity => bounds.velocity.is_some(),
                    Field::Acceleration => bounds.acceleration.is_some(),
                    _ => false,
                };
                let part = match in_box {
                    true => Part::Box(field, joint),
                    false => Part::Limit(joint, field),
                };
                let message = format!(
                    "the {what} limit of joint {name} is 0, but the tolerance{of} of scene `{}` is \
                     relative to the actuator",
                    self.scene.name
                );
                let help = format!("give a {what} above 0, or relative_to = \"range\"");
                self.say(part, message, &help);
            }
            Some(_) => {}
        }
    }
}
