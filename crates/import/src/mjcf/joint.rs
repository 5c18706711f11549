//! A joint: where it is, what it turns about, and its limits.

use dalembert_model::number::{Rational, Wide};
use dalembert_model::placed::frame::direction;
use dalembert_model::robot::Position;
use dalembert_model::scalar::Scalar;
use num_traits::{Signed, Zero};

use super::Mjcf;
use super::world::Item;
use crate::model::{Joint, Kind, Number, Value, or_zero};
use crate::orientation::Pose;
use crate::text::Span;
use crate::xml::Element;

const KINDS: [(&str, Kind); 4] = [
    ("hinge", Kind::Revolute),
    ("slide", Kind::Prismatic),
    ("free", Kind::Floating),
    ("ball", Kind::Ball),
];

impl Mjcf<'_, '_, '_> {
    /// Reads a joint of the body at a pose. Returns also the joint's anchor, in the body's frame.
    pub(super) fn joint(&mut self, item: &Item, name: String, at: &Pose) -> (Joint, [Rational; 3]) {
        let (element, frame) = (item.element, &item.frame);
        let of = format!("joint `{name}`");
        let around = self.reader.problems.enter(&element.at);
        self.reader.check("body", element, &of);
        let none = [(); 3].map(|()| Rational::zero());
        if element.tag == "freejoint" {
            self.reader.problems.leave(around);
            let kind = Kind::Floating;
            let fixed = fixed(["", ""], &element.at, at);
            return (
                Joint {
                    name,
                    kind,
                    ..fixed
                },
                none,
            );
        }
        let word = self.reader.word(element, "type", &KINDS);
        let kind = word.unwrap_or(Kind::Revolute);
        let numbers = self.reader.numbers(element, "axis");
        let up = || Number::constants(["0", "0", "1"], &element.at);
        let axis = frame.rotate(&numbers.unwrap_or_else(up));
        let pos = self.reader.vector(element, "pos");
        let anchor = match kind {
            // The place of a slide has no effect.
            Kind::Prismatic | Kind::Floating => none,
            _ => frame.apply(&pos.map(|x| x.value)),
        };
        let along = direction(&axis.each_ref().map(|x| x.value.clone()));
        if along.is_none() && kind.has_one_axis() {
            let help = "axis=\"0 0 1\"";
            self.reader
                .report("no_direction", &axis[0].at, &[&name, &help]);
        }
        let along = along.unwrap_or([(); 3].map(|()| Wide::zero()));
        let place = at.shift(&anchor);
        let zero = self.reader.number(element, "ref");
        let (place, start) = match (zero.filter(|zero| !zero.value.is_zero()), kind) {
            (Some(zero), Kind::Revolute) => {
                let angle = self.angle(&zero);
                (place.turn(&along, &angle.negate()), angle.radians())
            }
            (Some(zero), Kind::Prismatic) => {
                let back = along.map(|x| x.to_rational() * -&zero.value);
                (place.shift(&back), zero.value)
            }
            (zero, _) => (place, or_zero(zero)),
        };
        let [armature, damping] = self.loads(element, &of);
        let friction = self.reader.number(element, "frictionloss");
        self.not_negative("frictionloss", &friction, &of);
        let spring = self.first_term(element, "stiffness", &of);
        let range = self.limits(element, "limited", "range");
        let range = self.reader.range(&name, range);
        let effort = self.force_range(element, "actuatorfrclimited", "actuatorfrcrange");
        self.reader.problems.leave(around);
        let off = |flag: &str| self.settings.is_off(flag);
        let joint = Joint {
            name,
            kind,
            origin: place.origin(),
            axis,
            position: range.map(|range| range.map(|end| self.in_units(kind, end))),
            start,
            effort,
            damping,
            friction: friction.filter(|_| !off("frictionloss")),
            spring: spring.filter(|spring| !spring.value.is_zero() && !off("spring")),
            armature: or_zero(armature),
            ..fixed(["", ""], &element.at, at)
        };
        (joint, anchor)
    }

    /// Returns the larger end of a range of forces.
    pub(super) fn force_range(
        &mut self,
        element: &Element,
        word: &str,
        key: &str,
    ) -> Option<Number> {
        let range = self.limits(element, word, key)?;
        let [low, high] = range.map(|end| end.map(|value| value.abs()));
        let largest = if low.value > high.value { low } else { high };
        (!largest.value.is_zero()).then_some(largest)
    }

    fn in_units(&self, kind: Kind, end: Number) -> Value<Position> {
        let (value, unit) = match kind {
            Kind::Prismatic => (Position::Length(end.value.clone()), ""),
            Kind::Revolute if self.settings.degrees => (Position::Angle(self.angle(&end)), "deg"),
            _ => (Position::Angle(self.angle(&end)), ""),
        };
        Value::new(value, format!("{}{unit}", end.text), &end.at)
    }
}

pub(super) fn fixed(ends: [&str; 2], at: &Span, pose: &Pose) -> Joint {
    let ends = ends.map(|name| (name.to_owned(), at.clone()));
    Joint::fixed(ends, at, pose.origin())
}
