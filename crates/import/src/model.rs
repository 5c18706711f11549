//! A model as its file says it, in either format: links, joints, and what ties them.

use dalembert_model::number::parse::parse_decimal;
use dalembert_model::number::{Angle, Rational};
use dalembert_model::placed::Body;
use dalembert_model::robot::values::number;
use dalembert_model::robot::{Inertia, Placement, Position};
use num_traits::{Signed, Zero};

use crate::problems::{Problems, instead};
use crate::text::Span;

pub(crate) const MAX_LINKS: usize = 1024;

#[derive(Clone, Debug, Default)]
pub(crate) struct Model {
    pub(crate) format: Format,
    pub(crate) name: String,
    pub(crate) at: Span,
    pub(crate) links: Vec<Link>,
    pub(crate) joints: Vec<Joint>,
    /// The parent and the child of each joint, by their places among the links.
    pub(crate) ends: Vec<[usize; 2]>,
    /// The joint that each link hangs on.
    pub(crate) above: Vec<Option<usize>>,
    /// Gravity in the axes of the root, where the file says it.
    pub(crate) gravity: Option<[Number; 3]>,
    pub(crate) ties: Vec<Tie>,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Format {
    #[default]
    Urdf,
    Mjcf,
}

#[derive(Clone, Debug, Default)]
pub(crate) struct Link {
    pub(crate) name: String,
    pub(crate) at: Span,
    /// None for a frame without mass.
    pub(crate) inertial: Option<Inertial>,
    pub(crate) role: Role,
    pub(crate) has_unknown_mass: bool,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Role {
    #[default]
    Body,
    /// Nothing: it lies between two joints of one body.
    Between,
    /// A frame or a weight on a body, at which no chain ends unless that is asked for.
    Mark,
}

#[derive(Clone, Debug)]
pub(crate) struct Inertial {
    /// The centre of mass, and the axes of the inertia.
    pub(crate) origin: Origin,
    pub(crate) mass: Number,
    pub(crate) inertia: Inertia<Number>,
}

#[derive(Clone, Debug, Default)]
pub(crate) struct Joint {
    pub(crate) name: String,
    pub(crate) at: Span,
    pub(crate) kind: Kind,
    /// The child's frame at q = 0, in the parent's.
    pub(crate) origin: Origin,
    pub(crate) parent: (String, Span),
    pub(crate) child: (String, Span),
    pub(crate) axis: [Number; 3],
    pub(crate) position: Option<[Value<Position>; 2]>,
    /// The position in the model's initial pose, rad or m.
    pub(crate) start: Rational,
    pub(crate) effort: Option<Number>,
    pub(crate) velocity: Option<Number>,
    pub(crate) acceleration: Option<Number>,
    pub(crate) damping: Option<Number>,
    /// Coulomb friction and a spring, which a robot file does not get: the report names them.
    pub(crate) friction: Option<Number>,
    pub(crate) spring: Option<Number>,
    pub(crate) armature: Rational,
    /// The inertia of each rotor, and its reduction.
    pub(crate) rotors: Vec<[Number; 2]>,
    pub(crate) mimic: Option<Mimic>,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Kind {
    Revolute,
    Continuous,
    Prismatic,
    #[default]
    Fixed,
    Planar,
    Floating,
    /// About any axis.
    Ball,
}

#[derive(Clone, Debug)]
pub(crate) struct Mimic {
    pub(crate) leader: String,
    pub(crate) at: Span,
    /// Multiplier and offset, if the joint follows along a line.
    pub(crate) line: Option<[Rational; 2]>,
}

#[derive(Clone, Debug)]
pub(crate) struct Tie {
    pub(crate) at: Span,
    /// As messages call it: ``the fixed tendon `split` ``.
    pub(crate) name: String,
    pub(crate) ends: Ends,
}

#[derive(Clone, Debug)]
pub(crate) enum Ends {
    /// Joints, none of which moves by itself.
    Joints(Vec<String>),
    Links(Vec<String>),
}

/// A value with its digits and its place.
#[derive(Clone, Debug, Default)]
pub(crate) struct Value<T> {
    pub(crate) value: T,
    /// The digits as written.
    pub(crate) text: String,
    pub(crate) at: Span,
}

pub(crate) type Number = Value<Rational>;

/// The pose of a frame in another; `rpy` is about fixed axes.
#[derive(Clone, Debug, Default)]
pub(crate) struct Origin {
    pub(crate) xyz: [Number; 3],
    pub(crate) rpy: [Value<Angle>; 3],
    /// The placement that was meant by digits that are not angles, as a quaternion's.
    pub(crate) meant: Option<Placement>,
}

impl Kind {
    pub(crate) const WORDS: [(&'static str, Kind); 6] = [
        ("revolute", Kind::Revolute),
        ("continuous", Kind::Continuous),
        ("prismatic", Kind::Prismatic),
        ("fixed", Kind::Fixed),
        ("planar", Kind::Planar),
        ("floating", Kind::Floating),
    ];

    pub(crate) fn word(self) -> &'static str {
        let entry = Kind::WORDS.iter().find(|(_, kind)| *kind == self);
        entry.map_or("a ball", |(word, _)| word)
    }

    /// True if the position is one number, or none for a joint that is fixed.
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

impl<T> Value<T> {
    pub(crate) fn new(value: T, text: impl Into<String>, at: &Span) -> Value<T> {
        let (text, at) = (text.into(), at.clone());
        Value { value, text, at }
    }

    pub(crate) fn map<U>(self, f: impl FnOnce(T) -> U) -> Value<U> {
        Value::new(f(self.value), self.text, &self.at)
    }
}

impl Number {
    /// Returns a number of ours, such as "0".
    pub(crate) fn constant(text: &str, at: &Span) -> Number {
        Value::new(parse_decimal(text).unwrap_or_default(), text, at)
    }

    pub(crate) fn of(value: &Rational, at: &Span) -> Number {
        Value::new(value.clone(), number(value), at)
    }

    pub(crate) fn constants<const N: usize>(texts: [&str; N], at: &Span) -> [Number; N] {
        texts.map(|text| Number::constant(text, at))
    }
}

impl Inertial {
    /// Returns the weight in the frame of its centre of mass.
    pub(crate) fn body(&self) -> Body {
        Body {
            mass: self.mass.value.clone(),
            com: [(); 3].map(|()| Rational::zero()),
            inertia: self.inertia.map(|entry| entry.value.clone()),
        }
    }
}

impl Link {
    pub(crate) fn new(name: String, at: &Span) -> Link {
        let at = at.clone();
        Link {
            name,
            at,
            ..Link::default()
        }
    }
}

/// Returns a limit that bounds something.
pub(crate) fn positive(limit: &Option<Number>) -> Option<&Number> {
    limit.as_ref().filter(|limit| limit.value.is_positive())
}

impl Origin {
    pub(crate) fn placement(&self) -> Placement {
        Placement {
            xyz: self.xyz.each_ref().map(|x| x.value.clone()),
            rpy: self.rpy.each_ref().map(|x| x.value.clone()),
        }
    }
}

impl Joint {
    pub(crate) fn fixed([parent, child]: [(String, Span); 2], at: &Span, origin: Origin) -> Joint {
        Joint {
            name: format!("to {}", child.0),
            axis: Number::constants(["0", "0", "1"], at),
            at: at.clone(),
            origin,
            parent,
            child,
            ..Joint::default()
        }
    }

    /// Adds damping, which is times the square of a ratio.
    pub(crate) fn add_damping(&mut self, damping: Option<Number>, ratio: &Rational) {
        if let Some(damping) = damping.filter(|damping| !damping.value.is_zero()) {
            let more = damping.map(|value| value * ratio * ratio);
            self.damping = Some(added(self.damping.take(), more));
        }
    }

    /// Adds a rotor to the armature: its inertia times the square of the reduction.
    pub(crate) fn add_rotor(&mut self, inertia: Number, ratio: Number) {
        self.armature += &inertia.value * &ratio.value * &ratio.value;
        if inertia.value != Rational::default() {
            self.rotors.push([inertia, ratio]);
        }
    }
}

impl Model {
    /// Returns the joints that move, from the root outwards, each branch to its ends before the
    /// next in the file.
    pub(crate) fn moving(&self) -> Vec<usize> {
        let joints = || (0..self.joints.len()).rev();
        let is_root = |link: usize| self.ends.iter().all(|[_, child]| *child != link);
        let is_first = |joint: &usize| is_root(self.ends[*joint][0]);
        let mut open: Vec<usize> = joints().filter(is_first).collect();
        let mut visits = std::collections::BTreeSet::new();
        let mut moving = Vec::new();
        while let Some(joint) = open.pop() {
            if visits.insert(joint) {
                moving.extend((self.joints[joint].kind != Kind::Fixed).then_some(joint));
                open.extend(joints().filter(|next| self.ends[*next][0] == self.ends[joint][1]));
            }
        }
        moving
    }

    /// Finds the ends of each joint; a link that is missing is an error.
    pub(crate) fn resolve(&mut self, problems: &mut Problems) {
        let mut end = |(name, at): &(String, Span)| {
            let place = self.link(name);
            if place.is_none() && !name.is_empty() {
                let help = instead(name, self.links.iter().map(|link| &link.name));
                problems.report("no_link", at, &[name, &help]);
            }
            place.unwrap_or_default()
        };
        let joints = self.joints.iter();
        let ends = joints.map(|joint| [end(&joint.parent), end(&joint.child)]);
        self.ends = ends.collect();
        self.above = vec![None; self.links.len()];
        for (joint, [_, child]) in self.ends.iter().enumerate() {
            let above = self.above.get_mut(*child);
            let (link, at) = &self.joints[joint].child;
            // A name that two links have is an error by itself.
            let links = self.links.iter().filter(|other| other.name == *link);
            if let Some(other) = above.and_then(|above| above.replace(joint))
                && links.count() == 1
            {
                problems.report("hangs_already", at, &[link, &self.joints[other].name]);
            }
        }
    }

    /// Returns the joints from a link up to the root, or once around a circle.
    pub(crate) fn way(&self, link: usize) -> impl Iterator<Item = usize> {
        let up = |joint: &usize| self.above[self.ends[*joint][0]];
        std::iter::successors(self.above[link], up).take(self.ends.len())
    }

    pub(crate) fn link(&self, name: &str) -> Option<usize> {
        self.links.iter().position(|link| link.name == name)
    }

    /// Finds a joint by its name, or by its number, from 1, among those that move.
    pub(crate) fn joint(&self, name: &str) -> Option<usize> {
        let named = self.joints.iter().position(|joint| joint.name == name);
        named.or_else(|| {
            let number: usize = name.parse().ok()?;
            self.moving().get(number.checked_sub(1)?).copied()
        })
    }

    /// Leaves out all ties, with a note.
    pub(crate) fn untie(&mut self, problems: &mut Problems) {
        let mut ties: Vec<_> = self.ties.drain(..).map(|tie| (tie.at, tie.name)).collect();
        for joint in &mut self.joints {
            if let Some(mimic) = joint.mimic.take_if(|mimic| mimic.line.is_none()) {
                ties.push((mimic.at, format!("the equality of joint `{}`", joint.name)));
            }
        }
        if let Some((first, _)) = ties.first() {
            let names: Vec<&str> = ties.iter().map(|(_, name)| name.as_str()).collect();
            problems.report("ignored_ties", first, &[&names.join(", ")]);
        }
    }
}

/// Returns the least of some limits, the first of those that are equal.
pub(crate) fn least<const N: usize>(limits: [Option<Number>; N]) -> Option<Number> {
    let limits = limits.into_iter().flatten();
    limits.min_by(|one, other| one.value.cmp(&other.value))
}

pub(crate) fn or_zero(number: Option<Number>) -> Rational {
    number.map_or_else(Rational::zero, |number| number.value)
}

/// Returns the sum of two numbers, of which the first may be missing.
pub(crate) fn added(sum: Option<Number>, more: Number) -> Number {
    let before = or_zero(sum);
    more.map(|value| before + value)
}
