//! Actuators, as limits of torque.

use std::collections::BTreeMap;

use dalembert_model::number::Rational;
use num_traits::{One, Signed};
use roxmltree::Node;

use super::{Mjcf, within};
use crate::urdf::{Number, Urdf};

impl<'a> Mjcf<'a, '_, '_> {
    /// The limit is the sum of the forces that drive a joint, or its own where that is less.
    pub(super) fn forces(&mut self, root: Node<'a, '_>, urdf: &mut Urdf) {
        let mut limits: BTreeMap<&str, Option<Number>> = BTreeMap::new();
        for node in within(root, "actuator") {
            let joint = node.attribute("joint").or(node.attribute("jointinparent"));
            let Some(joint) = joint else {
                continue;
            };
            let own = self.force(node);
            let limit = match limits.remove(joint) {
                None => own,
                // One without a limit leaves none.
                Some(before) => before.zip(own).map(|(before, own)| Number {
                    value: before.value + &own.value,
                    ..own
                }),
            };
            limits.insert(joint, limit);
        }
        for joint in &mut urdf.joints {
            let Some(limit) = limits.remove(joint.name.as_str()).flatten() else {
                continue;
            };
            let own = joint.effort.take();
            let is_less = |own: &Number| own.value < limit.value;
            joint.effort = own.filter(is_less).or(Some(limit));
        }
    }

    fn force(&mut self, node: Node<'a, '_>) -> Option<Number> {
        let class = self.class_of(node, "class", 0);
        let force = self.force_range(node, class, "forcerange", "forcelimited");
        // What a motor is told is its force.
        let is_motor = node.has_tag_name("motor") && force.is_none();
        let force = match is_motor {
            true => self.force_range(node, class, "ctrlrange", "ctrllimited"),
            false => force,
        };
        let gear = match self.text(node, class, "gear") {
            None => Rational::one(),
            Some((text, span)) => {
                let first = text.split_ascii_whitespace().next().unwrap_or_default();
                self.problems.parse(first, span)?.value.abs()
            }
        };
        let force = force?.map(|value| value * gear);
        force.value.is_positive().then_some(force)
    }
}
