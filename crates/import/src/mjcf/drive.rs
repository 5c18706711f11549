//! Actuators: limits of torque, rotors and damping of the joints that they drive.

use std::collections::BTreeMap;

use dalembert_model::number::Rational;
use num_traits::{One, Signed};

use super::Mjcf;
use super::tie::Tendons;
use crate::model::{Number, added, least};
use crate::xml::{Attribute, Element};

impl Mjcf<'_, '_, '_> {
    /// Adds to the joints what drives them. The limit of a joint is the sum of the forces of its
    /// drives, or its own where that is less.
    pub(super) fn drives(&mut self, root: &Element, tendons: &Tendons) {
        let mut limits: BTreeMap<usize, Option<Number>> = BTreeMap::new();
        for element in self.section(root, "actuator") {
            let of = element.named(&format!("<{}>", element.tag));
            let Some((joint, coefficient)) = self.driven(element, tendons) else {
                self.reader.check("actuator", element, &of);
                continue;
            };
            let at = self.model.joints[joint].at.clone();
            let around = self.reader.problems.enter(&at);
            self.reader.check("actuator", element, &of);
            let first = self.reader.first(element, "gear");
            let number = first.unwrap_or_else(|| Number::constant("1", &element.at));
            let gear = number.map(|value| value * coefficient);
            let before_gear = self.force(element);
            let geared = before_gear.map(|force| force.map(|value| value * gear.value.abs()));
            let force = geared.filter(|force| force.value.is_positive());
            let limit = match (limits.remove(&joint), force) {
                (None, force) => force,
                (Some(Some(before)), Some(force)) => Some(added(Some(before), force)),
                // One without a limit leaves none.
                (Some(_), _) => None,
            };
            limits.insert(joint, limit);
            self.rotor(element, joint, gear, &of);
            let input = element.value("input");
            if element.tag == "dcmotor" && input == Some("none") {
                self.reader.report("brake", &element.at, &[&of]);
            }
            self.reader.problems.leave(around);
        }
        for (joint, limit) in limits {
            let joint = &mut self.model.joints[joint];
            if limit.is_some() {
                joint.effort = least([limit, joint.effort.take()]);
            }
        }
    }

    /// Returns the joint that an actuator drives, and how far its tendon goes with the joint.
    fn driven(&mut self, element: &Element, tendons: &Tendons) -> Option<(usize, Rational)> {
        let attributes = ["joint", "jointinparent", "tendon"].map(|key| element.get(key));
        let targets: Vec<&Attribute> = attributes.into_iter().flatten().collect();
        let [target] = targets[..] else {
            let second = targets.get(1)?;
            let reader = &mut *self.reader;
            return reader.refuse("two_targets", &second.at, &[&element.tag]);
        };
        if target.key != "tendon" {
            let joint = self.joint_named(&target.value, &target.at)?;
            return Some((joint, Rational::one()));
        }
        match &tendons.get(&target.value)?[..] {
            [(joint, coefficient)] => Some((*joint, coefficient.clone())),
            _ => None,
        }
    }

    /// Returns the largest force of an actuator before its gear.
    fn force(&mut self, element: &Element) -> Option<Number> {
        let force = self.force_range(element, "forcelimited", "forcerange");
        let other = match element.tag.as_str() {
            // A motor is told its force.
            "motor" => self.force_range(element, "ctrllimited", "ctrlrange"),
            "dcmotor" => self.reader.first(element, "saturation"),
            _ => None,
        };
        least([force, other])
    }

    /// Adds the armature and the damping of a drive, each times the square of the reduction.
    fn rotor(&mut self, element: &Element, joint: usize, gear: Number, of: &str) {
        let [armature, damping] = self.loads(element, of);
        let joint = &mut self.model.joints[joint];
        joint.add_damping(damping, &gear.value);
        if let Some(armature) = armature {
            joint.add_rotor(armature, Number::of(&gear.value, &gear.at));
        }
    }
}
