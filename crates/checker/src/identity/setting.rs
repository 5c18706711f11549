//! A robot file in one of its scenes: which joints move by themselves, what stands still, which
//! results are asked for, and the box of states.

use std::f64::consts::PI;

use num_rational::BigRational as Rational;
use num_traits::{One, Signed, ToPrimitive, Zero};

use super::exact::{Angle, Exact, number};
use super::robot::{File, OneOrEach, Row, Scene, number_of};
use super::table::{Sizes, length};
use crate::payload::BodyRange;
use crate::places::Places;
use crate::program::{ARGUMENTS, Operand};

const MOST_JOINTS: usize = 64;
/// The most turns of a joint that follows, for one of its leader's.
const MOST_TURNS: i64 = 16;
/// The rounding of gravity as it is turned into the axes of a base makes it longer, in f32 by less than
/// this part.
const GRAVITY_SLACK: f64 = 1e-6;

/// A robot in a scene, or by itself.
pub struct Setting<'f> {
    pub(crate) file: &'f File,
    pub(super) scene: &'f Scene,
    pub(super) follows: Vec<Follows<'f>>,
    /// The rows whose joints move by themselves: joints are numbered by their places here.
    pub(super) movers: Vec<usize>,
    pub(super) locks: Vec<Option<&'f String>>,
    /// `true` where q̇, and q̈, is zero.
    pub(super) still: [bool; 2],
    /// True if the base floats, and the scene does not lock it.
    pub(super) floats: bool,
    /// The coordinates that results are over, from zero.
    pub rows: Vec<usize>,
    /// The places of the arguments of `load`.
    pub loading: Vec<usize>,
    /// The links whose bodies are among them, from one; a base that floats is zero.
    pub bodies: Vec<usize>,
    /// The numbers of these in the robot file.
    pub numbers: Vec<[f64; 10]>,
    /// Those of them that stay zero; empty if any may be another.
    pub zeros: Vec<bool>,
}

/// The line along which a joint follows another, which moves by itself; or itself, once.
pub(super) struct Follows<'f> {
    pub row: usize,
    pub times: Rational,
    /// The offsets on the way, each as often as it counts.
    pub offsets: Vec<(Rational, &'f String)>,
}

impl File {
    /// Returns the robot in the scene of a name, or by itself.
    ///
    /// # Errors
    /// A name or number that the file has not.
    pub fn setting(&self, name: Option<&str>) -> Result<Setting<'_>, String> {
        let count = self.joint.len();
        if !(1..=MOST_JOINTS).contains(&count) {
            return Err(format!("1 to {MOST_JOINTS} joints are read, not {count}"));
        }
        let missing = |name: &str| format!("the robot file has no scene `{name}`");
        let scene = match name {
            Some(name) => self.scene.get(name).ok_or_else(|| missing(name))?,
            None => &self.bare,
        };
        let follows = (0..count)
            .map(|row| self.follows(row))
            .collect::<Result<Vec<_>, String>>()?;
        let moves = |row: &usize| self.joint[*row].mimic.is_none();
        let movers: Vec<usize> = (0..count).filter(moves).collect();
        let joint = |word: &str| find(word, movers.iter().map(|row| &self.joint[*row]));
        let mut locks = vec![None; movers.len()];
        let mut floats = self.floating.is_some();
        for (word, position) in &scene.lock {
            match self.floating.is_some() && self.is_base(word) {
                true if position == "level" => floats = false,
                true => return Err("the base is locked, and not `level`".into()),
                false => locks[joint(word)?] = Some(position),
            }
        }
        let free = (0..movers.len()).filter(|&joint| locks[joint].is_none());
        let joints: Vec<usize> = match &scene.joints {
            Some(list) => list
                .iter()
                .map(|word| joint(word))
                .collect::<Result<_, _>>()?,
            None => free.collect(),
        };
        let base = if floats { 6 } else { 0 };
        let lists = [&scene.r#box.velocity, &scene.r#box.acceleration];
        for rates in lists.into_iter().flatten() {
            if rates.len() != base + movers.len() {
                return Err("a range of rates in the box of the scene has another length".into());
            }
        }
        let rows = (0..base).chain(joints.into_iter().map(|joint| base + joint));
        Ok(Setting {
            file: self,
            scene,
            follows,
            movers,
            locks,
            still: [scene.velocity.is_some(), scene.acceleration.is_some()],
            floats,
            rows: rows.collect(),
            loading: Vec::new(),
            bodies: Vec::new(),
            numbers: Vec::new(),
            zeros: Vec::new(),
        })
    }

    /// Returns the row of a joint's number, from one, or of its name.
    pub(super) fn row(&self, word: &str) -> Result<usize, String> {
        find(word, self.joint.iter())
    }

    pub(super) fn follows(&self, row: usize) -> Result<Follows<'_>, String> {
        let in_joint = |why: &str| format!("joint {}: {why}", row + 1);
        let (mut at, mut times, mut offsets) = (row, Rational::one(), Vec::new());
        for _ in 0..=self.joint.len() {
            let Some(mimic) = &self.joint[at].mimic else {
                return Ok(Follows {
                    row: at,
                    times,
                    offsets,
                });
            };
            offsets.extend(mimic.offset.as_ref().map(|text| (times.clone(), text)));
            let factor = mimic.multiplier.as_ref().map_or("1", String::as_str);
            times *= number(factor).ok_or_else(|| in_joint("`multiplier` is not a number"))?;
            let leader = self.row(&mimic.joint)?;
            if self.joint[leader].kind != self.joint[row].kind {
                let why = "it turns and the joint that it follows slides, or vice versa";
                return Err(in_joint(why));
            }
            let most = Rational::from_integer(MOST_TURNS.into());
            if self.joint[row].turns() && !(times.is_integer() && times.abs() <= most) {
                return Err(in_joint("`multiplier` of an angle is not an integer"));
            }
            at = leader;
        }
        Err(in_joint("joints follow each other in a cycle"))
    }
}

fn find<'r>(word: &str, mut rows: impl ExactSizeIterator<Item = &'r Row>) -> Result<usize, String> {
    let row = match word.parse::<usize>() {
        Ok(number) => number.checked_sub(1).filter(|&row| row < rows.len()),
        Err(_) => rows.position(|row| row.name.as_deref() == Some(word)),
    };
    row.ok_or_else(|| format!("there is no joint `{word}`"))
}

impl Row {
    pub(super) fn turns(&self) -> bool {
        self.kind == "revolute"
    }

    fn position(&self, text: &str) -> Option<f64> {
        match self.turns() {
            true => Angle::read(text)?.radians(),
            false => number(text)?.to_f64(),
        }
    }
}

impl Setting<'_> {
    /// Returns how many joints move by themselves, locked ones too.
    pub fn joints(&self) -> usize {
        self.movers.len()
    }

    /// Returns the names of joints' places in generated code, if the robot is a tree.
    pub(crate) fn places(&self) -> Option<Places> {
        let name = |row: &usize| self.file.joint[*row].name.as_deref();
        let names: Vec<Option<&str>> = self.movers.iter().map(name).collect();
        let starts = || self.limbs().iter().map(|limb| limb[0]).collect();
        let limbs = self.floats.then(starts);
        self.file.is_tree().then(|| Places::new(&names, limbs))
    }

    /// Returns how many coordinates come before those of the joints.
    pub fn base(&self) -> usize {
        if self.floats { 6 } else { 0 }
    }

    /// Returns the numbers that lengths follow from.
    pub fn sizes(&self) -> Sizes {
        Sizes {
            joints: self.joints(),
            coordinates: self.base() + self.joints(),
            bodies: self.links() + usize::from(self.floats),
            argument_bodies: self.bodies.len(),
            table: self.links(),
        }
    }

    /// Returns how many entries an argument of the state has: a joint each, or a coordinate each.
    pub fn entries(&self, place: usize) -> usize {
        let axis = ARGUMENTS.get(place).map_or('0', |argument| argument.1);
        length(axis, self.sizes())
    }

    /// Returns the joints among the coordinates that results are over.
    pub fn joint_rows(&self) -> Vec<usize> {
        let joint = |row: &usize| row.checked_sub(self.base());
        self.rows.iter().filter_map(joint).collect()
    }

    /// Returns the limbs of a base that floats, as joints: limbs that alternate, or of which one follows
    /// another's joint, count as one.
    fn limbs(&self) -> Vec<Vec<usize>> {
        let mut spans: Vec<(usize, [usize; 2])> = Vec::new();
        for (row, follows) in self.follows.iter().enumerate() {
            let place = self.movers.iter().position(|row| *row == follows.row);
            let joint = place.unwrap_or_default();
            let carrier = self.file.carrier(row).ok().flatten();
            let root = carrier.map_or(row, |carrier| spans[carrier].0);
            spans.push((root, [joint; 2]));
            let [first, last] = &mut spans[root].1;
            (*first, *last) = (joint.min(*first), joint.max(*last));
        }
        let mut limbs: Vec<Vec<usize>> = Vec::new();
        for joint in 0..self.joints() {
            let holds = |(_, [first, last]): &(usize, [usize; 2])| *first < joint && joint <= *last;
            match limbs.last_mut() {
                Some(limb) if spans.iter().any(holds) => limb.push(joint),
                _ => limbs.push(vec![joint]),
            }
        }
        limbs
    }

    /// Returns the places in D of the entries of one block a limb, over the rows of results.
    pub(super) fn blocks(&self) -> Vec<usize> {
        let (mut places, coordinates) = (Vec::new(), self.sizes().coordinates);
        for limb in self.limbs() {
            let is_in = |row: &&usize| {
                let joint = row.checked_sub(self.base());
                joint.is_some_and(|joint| limb.contains(&joint))
            };
            let rows: Vec<usize> = self.rows.iter().filter(is_in).copied().collect();
            for row in &rows {
                places.extend(rows.iter().map(|column| row * coordinates + column));
            }
        }
        places
    }

    /// Returns how many links there are.
    pub fn links(&self) -> usize {
        self.file.joint.len()
    }

    /// Returns by how much the degree in a joint's sines grows for those that follow it.
    pub(super) fn turns(&self) -> f64 {
        let rows = self.file.joint.iter().zip(&self.follows);
        let followers = rows.filter(|(row, _)| row.mimic.is_some());
        let turns =
            followers.map(|(_, follows)| follows.times.abs().to_f64().unwrap_or(f64::INFINITY));
        turns.fold(1.0, |total, turn| total + turn)
    }

    /// Returns the speed over which Coulomb friction is smoothed; none of a joint without.
    pub(super) fn width(&self, joint: usize) -> Result<Option<Rational>, String> {
        let row = &self.file.joint[self.movers[joint]];
        let force = number_of(row.coulomb.as_ref())?;
        let width = number_of(row.coulomb_width.as_ref())?;
        match (force.is_zero(), width.is_positive()) {
            (true, _) => Ok(None),
            (false, true) => Ok(Some(width)),
            _ => Err(format!(
                "joint {}: `coulomb` without a `coulomb_width`",
                joint + 1
            )),
        }
    }

    /// Returns the ranges of an argument's entries: the scene's, else the limits of the joints,
    /// else these rates; of what the file does not speak of, none. The box of states is that of
    /// q, q̇ and q̈; what a controller wishes for is in the same.
    ///
    /// # Errors
    /// A range that is empty, or no range.
    pub fn ranges(&self, name: &str, rate: f64) -> Result<Option<Vec<[f64; 2]>>, String> {
        let (limit, is_still) = match name {
            "q" => ("position", false),
            "qd" => ("velocity", self.still[0]),
            "qdd" => ("acceleration", self.still[1]),
            "v" => ("velocity", false),
            "a" => ("acceleration", false),
            "tau" => ("torque", false),
            _ => return Ok(None),
        };
        let of_rate = |coordinate: usize| {
            if self.is_held(coordinate) || is_still {
                return Some([0.0; 2]);
            }
            let text = self.limit_text(coordinate, limit);
            let most = text.map_or(Some(rate), |text| number(text)?.to_f64());
            most.map(|most| [-most, most])
        };
        let before = if limit == "position" { 0 } else { self.base() };
        let range = |place: usize| {
            let range = match limit {
                "position" => self.positions(place, rate),
                _ => of_rate(place),
            };
            let range = range.filter(|[low, high]| low <= high);
            range.ok_or_else(|| match place.checked_sub(before) {
                Some(joint) => format!("joint {}: the range of `{name}` is empty", joint + 1),
                None => format!("the base: the range of `{name}` is empty"),
            })
        };
        let ranges = (0..before + self.joints()).map(range);
        Ok(Some(ranges.collect::<Result<_, String>>()?))
    }

    /// Returns the bodies that a payload may be: those of the scene's box, else of the robot's limits.
    ///
    /// # Errors
    /// A range that is empty, or not a range.
    pub fn body(&self) -> Result<Option<BodyRange>, String> {
        let scene_payload = self.scene.r#box.payload.as_ref();
        let payload = scene_payload.or(self.file.limits.payload.as_ref());
        payload.map(|range| range.read("payload")).transpose()
    }

    fn positions(&self, joint: usize, rate: f64) -> Option<[f64; 2]> {
        let row = &self.file.joint[self.movers[joint]];
        if let Some(at) = self.locks[joint] {
            return Some([row.position(at)?; 2]);
        }
        let positions = self.scene.r#box.position.as_ref();
        let range = positions.and_then(|list| list.get(joint));
        match range.or(row.limits.position.as_ref()) {
            Some([low, high]) => Some([row.position(low)?, row.position(high)?]),
            None if row.turns() => Some([-PI, PI]),
            // A joint that slides without an end: a metre either way, unless every state counts.
            None if rate.is_finite() => Some([-1.0, 1.0]),
            None => Some([-rate, rate]),
        }
    }

    /// Returns true for a joint whose position has limits.
    pub fn is_limited(&self, joint: usize) -> bool {
        let limit = &self.file.joint[self.movers[joint]].limits.position;
        self.scene.r#box.position.is_some() || limit.is_some()
    }

    /// Returns how long gravity is in the axes of a base that floats, m/s², however that is turned; none
    /// on a fixed base.
    pub(crate) fn gravity(&self) -> Option<f64> {
        let gravity = self.scene.gravity.as_ref().unwrap_or(&self.file.gravity);
        let square = |text: &String| Some(number(text)?.to_f64()?.powi(2));
        let squares = gravity.iter().map(square).collect::<Option<Vec<f64>>>()?;
        let length = squares.iter().sum::<f64>().sqrt() * (1.0 + GRAVITY_SLACK);
        self.floats.then_some(length)
    }

    /// Returns how far the results of each coordinate may be off, and relative to which scale; none where
    /// no tolerance is given.
    ///
    /// # Errors
    /// A text that is no number, or a list that has not one for each joint.
    pub fn tolerance(&self) -> Result<Option<(Vec<f64>, &str)>, String> {
        let Some(tolerance) = &self.scene.tolerance else {
            return Ok(None);
        };
        let (base, count) = (self.base(), self.base() + self.links());
        let tolerances = match &tolerance.value {
            OneOrEach::One(one) => vec![one; count],
            OneOrEach::Each(list) => list.iter().collect(),
        };
        let wrong = match base {
            0 => "`tolerance`: expected a number, or one a joint",
            _ => "`tolerance`: expected a number, or six of the base and one a joint",
        };
        // Down, so that nothing is allowed that the decimal does not allow.
        let read = |place: usize| Some(number(tolerances.get(place)?)?.to_f64()?.next_down());
        let places = (0..base).chain(self.movers.iter().map(|row| base + row));
        let values: Option<Vec<f64>> = places.map(read).collect();
        let whole = values.filter(|_| tolerances.len() == count);
        Ok(Some((whole.ok_or(wrong)?, &tolerance.relative_to)))
    }

    /// Returns a coordinate's limit of `velocity`, `acceleration` or `torque`, if there is one.
    pub fn limit(&self, coordinate: usize, name: &str) -> Option<f64> {
        number(self.limit_text(coordinate, name)?)?.to_f64()
    }

    /// Returns the text of a coordinate's limit: the box's, else that of the joint or the base.
    fn limit_text(&self, coordinate: usize, name: &str) -> Option<&String> {
        let bounds = &self.scene.r#box;
        let (of_box, place) = match name {
            "velocity" => (bounds.velocity.as_ref(), 0),
            "acceleration" => (bounds.acceleration.as_ref(), 1),
            _ => (None, 2),
        };
        let limit = of_box.and_then(|list| list.get(coordinate));
        limit.or_else(|| match coordinate.checked_sub(self.base()) {
            Some(joint) => {
                let limits = &self.file.joint[*self.movers.get(joint)?].limits;
                [&limits.velocity, &limits.acceleration, &limits.torque][place].as_ref()
            }
            None => {
                let limits = &self.file.floating.as_ref()?.limits;
                let lists = [&limits.velocity, &limits.acceleration, &limits.torque];
                lists[place].as_ref()?.get(coordinate)
            }
        })
    }

    /// Returns true for an operand that the scene fixes: the caller of a function may give another
    /// number for it.
    pub fn is_fixed<C>(&self, operand: &Operand<C>) -> bool {
        match operand {
            Operand::Sine(joint, _) => self.is_locked(*joint),
            Operand::Speed(coordinate) => self.is_held(*coordinate) || self.still[0],
            Operand::Entry(place, index) => {
                let is_still = matches!(place, 1 | 2) && self.still[place - 1];
                let is_locked = match ARGUMENTS.get(*place).map(|argument| argument.1) {
                    Some('j') => self.is_locked(*index),
                    Some('n') => self.is_held(*index),
                    _ => false,
                };
                is_locked || is_still
            }
            Operand::Step(_) | Operand::Constant(_) => false,
        }
    }

    /// Returns true for a joint that is locked.
    pub fn is_locked(&self, joint: usize) -> bool {
        self.locks.get(joint).is_some_and(Option::is_some)
    }

    pub(crate) fn is_held(&self, coordinate: usize) -> bool {
        let joint = coordinate.checked_sub(self.base());
        joint.is_some_and(|joint| self.is_locked(joint))
    }

    /// Returns true for a joint that turns.
    pub fn turns_by(&self, joint: usize) -> bool {
        let row = self.movers.get(joint);
        row.is_some_and(|row| self.file.joint[*row].turns())
    }

    /// Returns w² of a coordinate with Coulomb friction. Other coordinates may not be read: the identity
    /// takes their 1/√(q̇² + w²) to be zero.
    pub fn square_of_width(&self, coordinate: usize) -> Option<Exact> {
        let joint = coordinate.checked_sub(self.base())?;
        let is_joint = joint < self.joints();
        let width = is_joint.then(|| self.width(joint))?.ok()??;
        Some(Exact::from(&width * &width))
    }

    /// Returns true if rates of some joint have no limit.
    pub fn is_unlimited(&self) -> bool {
        let is_free = |coordinate: usize| {
            let mut limits = ["velocity", "acceleration"].into_iter();
            limits.any(|name| self.limit_text(coordinate, name).is_none())
        };
        (0..self.sizes().coordinates).any(is_free)
    }
}
