//! A joint: where it is, what it turns about, and its limits.

use std::ops::Range;

use dalembert_model::number::{Rational, Wide};
use dalembert_model::placed::frame::direction;
use dalembert_model::robot::Position;
use dalembert_model::scalar::Scalar;
use num_traits::{Signed, Zero};

use super::Mjcf;
use super::pose::Pose;
use super::world::Item;
use crate::problems::instead;
use crate::urdf::{Joint, Kind, Number, Value, constant, start_tag};

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
        let Item { node, frame, .. } = item;
        let node = *node;
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
            self.problems
                .error(&axis[0].span, message, "axis=\"0 0 1\"");
            return None;
        };
        let mut place = at.shift(&anchor);
        let zero = self
            .number(node, class, "ref")
            .filter(|zero| !zero.value.is_zero());
        match (&zero, kind) {
            (Some(zero), Kind::Revolute) => place = place.turn(&along, &self.angle(zero).negate()),
            (Some(zero), Kind::Prismatic) => {
                let back = along.map(|x| x.to_rational() * -&zero.value);
                place = place.shift(&back);
            }
            _ => {}
        }
        let start = match (zero, kind) {
            (Some(zero), Kind::Revolute) => self.angle(&zero).radians(),
            (Some(zero), _) => zero.value,
            (None, _) => Rational::zero(),
        };
        let mut number = |key| self.number(node, class, key);
        let [armature, damping, friction, spring] =
            ["armature", "damping", "frictionloss", "stiffness"].map(&mut number);
        let loads = [
            ("armature", &armature),
            ("damping", &damping),
            ("frictionloss", &friction),
        ];
        for (key, load) in loads {
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

    pub(super) fn force_range(
        &mut self,
        node: roxmltree::Node<'a, '_>,
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
