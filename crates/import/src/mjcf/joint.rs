//! A joint: where it is, what it turns about, and its limits; actuators limit its torque.

use std::collections::BTreeMap;
use std::ops::Range;

use dalembert_model::number::{Rational, Wide};
use dalembert_model::placed::frame::direction;
use dalembert_model::robot::Position;
use dalembert_model::scalar::Scalar;
use num_traits::{One, Signed, Zero};
use roxmltree::Node;

use super::pose::Pose;
use super::world::Item;
use super::{Mjcf, within};
use crate::problems::instead;
use crate::urdf::{Joint, Kind, Number, Urdf, Value, constant, start_tag};

const KINDS: [(&str, Kind); 4] = [
    ("hinge", Kind::Revolute),
    ("slide", Kind::Prismatic),
    ("free", Kind::Floating),
    ("ball", Kind::Ball),
];

impl<'a> Mjcf<'a, '_, '_> {
    /// Returns also the joint's anchor, in the body's frame.
    pub(super) fn joint(
        &mut self,
        item: &Item<'a, '_>,
        name: String,
        at: &Pose,
    ) -> Option<(Joint, [Rational; 3])> {
        let (node, frame) = (item.node, &item.frame);
        let class = self.class_of(node, "class", item.class);
        let span = start_tag(node);
        let still = Joint {
            name,
            kind: Kind::Floating,
            ..fixed(["", ""], &span, at)
        };
        let none = [(); 3].map(|()| Rational::zero());
        if node.has_tag_name("freejoint") {
            return Some((still, none));
        }
        let kind = match self.text(node, class, "type") {
            None => Kind::Revolute,
            Some((word, span)) => {
                let found = KINDS.iter().find(|(known, _)| *known == word);
                if found.is_none() {
                    let message = format!("`{word}` is no type of joint");
                    let help = instead(word, KINDS.iter().map(|(word, _)| *word));
                    self.problems.error(&span, message, &help);
                }
                found?.1
            }
        };
        let [axis, pos] = [("axis", ["0", "0", "1"]), ("pos", ["0", "0", "0"])].map(|(key, or)| {
            match self.text(node, class, key) {
                Some((text, span)) => self.problems.list(key, text, span),
                None => Some(constant(node, or)),
            }
        });
        let (axis, pos) = (frame.rotate(&axis?), pos?);
        let anchor = match kind {
            // Where it slides along says nothing of where it is.
            Kind::Prismatic | Kind::Floating => none,
            _ => frame.apply(&pos.map(|x| x.value)),
        };
        let along = direction(&axis.each_ref().map(|x| x.value.clone()));
        // What turns about any axis needs none.
        let any = [(); 3].map(|()| Wide::zero());
        let Some(along) = along.or((!kind.has_one_axis()).then_some(any)) else {
            let message = format!("the axis of joint `{}` has no direction", still.name);
            let span = &axis[0].span;
            return self.problems.refuse(span, message, "axis=\"0 0 1\"");
        };
        let place = at.shift(&anchor);
        let zero = self.number(node, class, "ref");
        let (place, start) = match (zero.filter(|zero| !zero.value.is_zero()), kind) {
            (Some(zero), Kind::Revolute) => {
                let angle = self.angle(&zero);
                (place.turn(&along, &angle.negate()), angle.radians())
            }
            (Some(zero), Kind::Prismatic) => {
                let back = along.map(|x| x.to_rational() * -&zero.value);
                (place.shift(&back), zero.value)
            }
            (zero, _) => (place, zero.map_or_else(Rational::zero, |zero| zero.value)),
        };
        let mut number = |key| self.number(node, class, key);
        let keys = ["armature", "damping", "frictionloss", "stiffness"];
        let [armature, damping, friction, spring] = keys.map(&mut number);
        for (key, load) in keys.into_iter().zip([&armature, &damping, &friction]) {
            if let Some(load) = load.as_ref().filter(|load| load.value.is_negative()) {
                let message = format!("the {key} of joint `{}` is negative", still.name);
                let help = "it adds inertia or takes energy out: zero or more";
                self.problems.error(&load.span, message, help);
            }
        }
        let position = match self.is_limited(node, class, "limited", "range") {
            true => self.list::<2>(node, class, "range"),
            false => None,
        };
        let position = self.problems.ordered(&still.name, position);
        let position = position.map(|range| range.map(|end| self.in_units(kind, end)));
        let joint = Joint {
            kind,
            origin: place.origin(),
            axis,
            position,
            start,
            effort: self.force_range(node, class, "actuatorfrcrange", "actuatorfrclimited"),
            damping,
            friction,
            spring: spring.filter(|spring| !spring.value.is_zero()),
            armature: armature.map_or_else(Rational::zero, |armature| armature.value),
            ..still
        };
        Some((joint, anchor))
    }

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
        let force = match force {
            // A motor is told its force.
            None if node.has_tag_name("motor") => {
                self.force_range(node, class, "ctrlrange", "ctrllimited")
            }
            force => force,
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

    fn force_range(
        &mut self,
        node: Node<'a, '_>,
        class: usize,
        key: &str,
        limited: &str,
    ) -> Option<Number> {
        if !self.is_limited(node, class, limited, key) {
            return None;
        }
        let [low, high] = self.list::<2>(node, class, key)?;
        let [low, high] = [low, high].map(|end| end.map(|value| value.abs()));
        let largest = if low.value > high.value { low } else { high };
        (!largest.value.is_zero()).then_some(largest)
    }

    fn in_units(&self, kind: Kind, end: Number) -> Value<Position> {
        let unit = match kind {
            Kind::Revolute if self.settings.degrees => "deg",
            _ => "",
        };
        let value = match kind {
            Kind::Prismatic => Position::Length(end.value.clone()),
            _ => Position::Angle(self.angle(&end)),
        };
        Value::new(value, format!("{}{unit}", end.text), &end.span)
    }
}

pub(super) fn fixed([parent, child]: [&str; 2], span: &Range<usize>, at: &Pose) -> Joint {
    let number = |x: i64| Value::new(Rational::from_integer(x.into()), x.to_string(), span);
    Joint {
        name: format!("to {child}"),
        kind: Kind::Fixed,
        axis: [0, 0, 1].map(number),
        span: span.clone(),
        origin: at.origin(),
        parent: (parent.to_owned(), span.clone()),
        child: (child.to_owned(), span.clone()),
        ..Joint::default()
    }
}
