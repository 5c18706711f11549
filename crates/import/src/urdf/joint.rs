//! A joint, its limits, and what drives it.

use std::ops::Range;

use dalembert_model::number::{Angle, Rational};
use dalembert_model::robot::Position;
use num_traits::{Signed, Zero};
use roxmltree::Node;

use super::{Number, Origin, Value, child, constant, start_tag};
use crate::problems::{Problems, instead};

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Kind {
    Revolute,
    Continuous,
    Prismatic,
    #[default]
    Fixed,
    Planar,
    Floating,
    /// About any axis: MJCF alone has it.
    Ball,
}

impl Kind {
    const WORDS: [(&'static str, Kind); 6] = [
        ("revolute", Kind::Revolute),
        ("continuous", Kind::Continuous),
        ("prismatic", Kind::Prismatic),
        ("fixed", Kind::Fixed),
        ("planar", Kind::Planar),
        ("floating", Kind::Floating),
    ];

    pub(crate) fn word(self) -> &'static str {
        let found = Kind::WORDS.iter().find(|(_, kind)| *kind == self);
        // The one that a URDF has no word for.
        found.map_or("a ball", |(word, _)| word)
    }

    pub(crate) fn has_one_axis(self) -> bool {
        !matches!(self, Kind::Planar | Kind::Floating | Kind::Ball)
    }

    /// Returns the position of a number of m or rad.
    pub(crate) fn position(self, value: Rational) -> Position {
        match self {
            Kind::Prismatic => Position::Length(value),
            _ => Position::Angle(Angle::Radians(value).canonical()),
        }
    }
}

#[derive(Clone, Debug, Default)]
pub(crate) struct Joint {
    pub(crate) name: String,
    pub(crate) span: Range<usize>,
    pub(crate) kind: Kind,
    /// The child's frame at q = 0, in the parent's.
    pub(crate) origin: Origin,
    pub(crate) parent: (String, Range<usize>),
    pub(crate) child: (String, Range<usize>),
    pub(crate) axis: [Number; 3],
    pub(crate) position: Option<[Value<Position>; 2]>,
    /// Where it is where the model is drawn, in rad or m.
    pub(crate) start: Rational,
    pub(crate) effort: Option<Number>,
    pub(crate) velocity: Option<Number>,
    pub(crate) damping: Option<Number>,
    /// Coulomb friction, which is not modelled.
    pub(crate) friction: Option<Number>,
    /// A spring, which is not modelled.
    pub(crate) spring: Option<Number>,
    pub(crate) armature: Rational,
    /// The inertia of each rotor, and its reduction.
    pub(crate) rotors: Vec<[Number; 2]>,
    pub(crate) mimic: Option<Mimic>,
}

#[derive(Clone, Debug)]
pub(crate) struct Mimic {
    pub(crate) joint: String,
    pub(crate) span: Range<usize>,
    /// Multiplier and offset, if it follows along a line.
    pub(crate) line: Option<[Rational; 2]>,
}

impl Problems<'_> {
    pub(super) fn joint(&mut self, node: Node) -> Option<Joint> {
        let (name, _) = self.attribute(node, "name")?;
        let kind = self.kind(node);
        let [parent, below] = ["parent", "child"].map(|end| {
            let Some(element) = child(node, end) else {
                let message = format!("joint `{name}` has no <{end}>");
                let help = format!("<{end} link=\"…\"/>");
                return self.refuse(&start_tag(node), message, &help);
            };
            let (link, span) = self.attribute(element, "link")?;
            Some((link.to_owned(), span))
        });
        let origin = self.origin(node);
        let axis = match child(node, "axis") {
            Some(axis) => self.triple(axis, "xyz"),
            // As the format has it.
            None => Some(constant(node, ["1", "0", "0"])),
        };
        let (kind, axis) = (kind?, axis?);
        let moves = !matches!(kind, Kind::Fixed | Kind::Floating);
        if moves && axis.iter().all(|x| x.value.is_zero()) {
            let message = format!("the axis of joint `{name}` has no direction");
            return self.refuse(&axis[0].span, message, "<axis xyz=\"0 0 1\"/>");
        }
        let limit = child(node, "limit");
        let mut of_limit = |key| limit.and_then(|limit| self.number(limit, key));
        let [lower, upper, effort, velocity] =
            ["lower", "upper", "effort", "velocity"].map(&mut of_limit);
        let dynamics = child(node, "dynamics");
        let mut of_dynamics = |key| dynamics.and_then(|dynamics| self.number(dynamics, key));
        let [damping, friction] = ["damping", "friction"].map(&mut of_dynamics);
        let position = match (lower, upper, limit) {
            (None, None, _) | (_, _, None) => None,
            (lower, upper, Some(limit)) => {
                let [zero] = constant(limit, ["0"]);
                Some([lower.unwrap_or(zero.clone()), upper.unwrap_or(zero)])
            }
        };
        let position = position.filter(|_| kind != Kind::Continuous);
        let in_units = |number: Number| number.map(|value| kind.position(value));
        let mimic = child(node, "mimic").map(|mimic| {
            let mut of = |key, or: i64| match mimic.has_attribute(key) {
                true => self.number(mimic, key).map(|number| number.value),
                false => Some(Rational::from_integer(or.into())),
            };
            let line = of("multiplier", 1).zip(of("offset", 0));
            Mimic {
                joint: mimic.attribute("joint").unwrap_or_default().to_owned(),
                span: start_tag(mimic),
                line: line.map(|(multiplier, offset)| [multiplier, offset]),
            }
        });
        for load in [&effort, &velocity, &damping].into_iter().flatten() {
            if load.value.is_negative() {
                let message = format!("`{}` of joint `{name}` is negative", load.text);
                let help = "a limit bounds the size, and damping takes energy out: zero or more";
                self.error(&load.span, message, help);
            }
        }
        Some(Joint {
            name: name.to_owned(),
            span: start_tag(node),
            kind,
            origin: origin?,
            parent: parent?,
            child: below?,
            axis,
            position: self
                .ordered(name, position)
                .map(|range| range.map(in_units)),
            effort,
            velocity,
            damping,
            friction,
            mimic,
            ..Joint::default()
        })
    }

    fn kind(&mut self, node: Node) -> Option<Kind> {
        let (word, span) = self.attribute(node, "type")?;
        let found = Kind::WORDS.iter().find(|(known, _)| *known == word);
        if found.is_none() {
            let words = Kind::WORDS.iter().map(|(word, _)| *word);
            let message = format!("`{word}` is no type of joint");
            self.error(&span, message, &instead(word, words));
        }
        found.map(|(_, kind)| *kind)
    }

    /// Equal limits, as where they were left at zero, are none; reversed ones are an error.
    pub(crate) fn ordered(
        &mut self,
        name: &str,
        position: Option<[Number; 2]>,
    ) -> Option<[Number; 2]> {
        let [lower, upper] = position?;
        if lower.value > upper.value {
            let message = format!("the limits of joint `{name}` are reversed");
            let help = "`lower` is the lowest position, `upper` the highest";
            return self.refuse(&lower.span, message, help);
        }
        if lower.value == upper.value {
            let message = format!("both limits of joint `{name}` are {}", lower.text);
            let help = "they are left out: a joint that does not move is `fixed`";
            self.warning(&lower.span, message, help);
            return None;
        }
        Some([lower, upper])
    }

    /// The armature is the inertia times the square of the reduction, for every driven joint.
    pub(super) fn transmission(&mut self, node: Node, joints: &mut [Joint]) {
        let children = |name: &'static str| node.children().filter(move |c| c.has_tag_name(name));
        let driven = children("joint").filter_map(|joint| joint.attribute("name"));
        let driven: Vec<&str> = driven.collect();
        let is_driven = |joint: &&mut Joint| driven.contains(&joint.name.as_str());
        // Names in tags of other spaces, as `drake:gear_ratio`, are theirs.
        let actuators = node.children();
        for actuator in actuators.filter(|c| c.tag_name().name() == "actuator") {
            // Files that were written for several tools have several reductions: the rotor's is in
            // the spelling of its own.
            let rotor = ROTORS.iter().find_map(|(rotors, ratios)| {
                Some((named(actuator, rotors)?, named(actuator, ratios)))
            });
            let Some((inertia, ratio)) = rotor else {
                continue;
            };
            let ratio = match ratio {
                Some(ratio) => self.of_actuator(ratio),
                None => Some(constant(inertia, ["1"])).map(|[one]| one),
            };
            let Some((inertia, ratio)) = self.of_actuator(inertia).zip(ratio) else {
                continue;
            };
            for joint in joints.iter_mut().filter(is_driven) {
                joint.armature += &inertia.value * &ratio.value * &ratio.value;
                if !inertia.value.is_zero() {
                    joint.rotors.push([inertia.clone(), ratio.clone()]);
                }
            }
        }
    }

    /// Reads a number of an actuator: `<gear_ratio value="…"/>`, or as its text.
    fn of_actuator(&mut self, found: Node) -> Option<Number> {
        if found.has_attribute("value") {
            return self.required(found, "value");
        }
        let text = found.text().unwrap_or_default().trim();
        self.parse(text, start_tag(found))
    }
}

fn named<'a, 'd>(node: Node<'a, 'd>, names: &[&str]) -> Option<Node<'a, 'd>> {
    names.iter().find_map(|name| child(node, name))
}

/// Names of a rotor's inertia, with those of the reduction that belongs to it, the likeliest first.
const ROTORS: [([&str; 2], [&str; 3]); 2] = [
    (
        ["rotor_inertia", "motor_inertia"],
        ["gear_ratio", "gearRatio", "mechanicalReduction"],
    ),
    (
        ["rotorInertia", "motorInertia"],
        ["gearRatio", "mechanicalReduction", "gear_ratio"],
    ),
];
