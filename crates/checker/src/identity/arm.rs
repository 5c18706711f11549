//! The arm in base axes: where every joint's axis and every link's mass is at q = 0, and at a
//! state.

use std::array::from_fn;
use std::iter::successors;

use num_rational::BigRational as Rational;
use num_traits::{ToPrimitive, Zero};

use super::exact::Point;
use super::number::Number;
use super::robot::{File, FloatingBase, Placement, Row, angle_of, number_of};
use super::screw::{Body, Pose, Ring, Screw, Vector, cross, dot, opposite, scaled, sum};
use super::setting::Setting;
use super::state::State;

/// A joint and its link, at q = 0 in base axes.
#[derive(Clone, Debug)]
pub struct Joint {
    /// The row whose link carries it; none of one that the base carries.
    pub(super) parent: Option<usize>,
    turns: bool,
    pub(super) axis: Screw,
    /// The joint that moves it, and how many times as far: itself, but for one that follows.
    pub leader: (usize, Number),
    /// The multiple of the leader's angle, and the sine and cosine, or the length, that is added.
    line: (i64, [Number; 2], Number),
    /// The origin of the frame whose z the axis is, and whether the joint moves it.
    pub(super) origin: (Vector, bool),
    pub(super) link: Pose,
    /// The link's frame in `link_poses`.
    pub(super) shown: Pose,
    pub(super) body: Body,
    pub(super) centred: (Body, Pose),
    /// Viscous friction, N·m·s/rad or N·s/m.
    pub viscous: Number,
    /// Coulomb friction, N·m or N.
    pub coulomb: Number,
    /// The inertia of the drive as the joint feels it, kg·m² or kg.
    pub armature: Number,
}

impl Joint {
    pub(super) fn motion(&self, state: &State) -> Pose {
        let (leader, factor) = self.leader;
        let (turns, offset, length) = self.line;
        let slide = state.arguments[0][leader] * factor + length;
        let pair = turned(times(state.pairs[leader], turns), offset);
        Pose::moved(self.axis, self.turns, pair, slide)
    }
}

pub(super) const HAND: &str = "hand";

#[derive(Clone, Debug)]
pub(super) struct Frame {
    pub(super) name: String,
    /// None for a base that floats.
    pub(super) row: Option<usize>,
    pub(super) pose: Pose,
}

/// An arm at q = 0.
#[derive(Clone, Debug)]
pub struct Arm {
    /// The rows of the table, from the base outward.
    pub joints: Vec<Joint>,
    pub(super) base: Option<Body>,
    pub(super) movers: Vec<usize>,
    pub(super) locked: Vec<usize>,
    /// The acceleration of gravity, m/s².
    pub(super) gravity: Vector,
    /// The hand, where links have one end, then the frames that have names.
    pub(super) frames: Vec<Frame>,
    /// One half, in this field.
    pub half: Number,
}

/// The joint that moves a row and how many times as far, and what is added.
type FollowerLine = ((usize, Number), (i64, [Number; 2], Number));

fn turned([sin, cos]: [Number; 2], [other_sin, other_cos]: [Number; 2]) -> [Number; 2] {
    [
        sin * other_cos + cos * other_sin,
        cos * other_cos - sin * other_sin,
    ]
}

fn times([sin, cos]: [Number; 2], count: i64) -> [Number; 2] {
    let one = [if count < 0 { -sin } else { sin }, cos];
    (0..count.abs()).fold([0.into(), 1.into()], |pair, _| turned(pair, one))
}

/// A body about its centre of mass, and where that is.
pub(super) type Carried<N> = (Body<N>, Pose<N>);

pub(super) trait Reading {
    type Number: Ring;

    fn entry(&self, text: Option<&String>) -> Result<Self::Number, String>;

    fn sines(&self, text: Option<&String>) -> Result<[Self::Number; 2], String>;

    fn list<const K: usize>(
        &self,
        list: [Option<&String>; K],
    ) -> Result<[Self::Number; K], String> {
        let mut numbers: [Self::Number; K] = from_fn(|_| 0i64.into());
        for (one, text) in numbers.iter_mut().zip(list) {
            *one = self.entry(text)?;
        }
        Ok(numbers)
    }

    fn turn(&self, axis: usize, text: Option<&String>) -> Result<Pose<Self::Number>, String> {
        Ok(Pose::turn(axis, self.sines(text)?))
    }

    fn placement(&self, placement: Option<&Placement>) -> Result<Pose<Self::Number>, String> {
        let place = placement.cloned().unwrap_or_default();
        let [xyz, rpy] = [&place.xyz, &place.rpy].map(|list| entries(list.as_ref()));
        let mut pose = Pose::shift(self.list(xyz)?);
        for axis in [2, 1, 0] {
            pose = pose.then(&self.turn(axis, rpy[axis])?);
        }
        Ok(pose)
    }

    fn body(
        &self,
        mass: &String,
        com: Option<&[String; 3]>,
        inertia: Option<&[String; 6]>,
    ) -> Result<Carried<Self::Number>, String> {
        let mass = self.entry(Some(mass))?;
        let [x, y, z] = [0i64; 3].map(Self::Number::from);
        let [xx, yy, zz, xy, yz, xz] = self.list(entries(inertia))?;
        let body = Body::new([mass, x, y, z, xx, yy, zz, xy, yz, xz]);
        Ok((body, Pose::shift(self.list(entries(com))?)))
    }

    fn ways(&self, row: &Row, convention: Option<&str>) -> Result<[Pose<Self::Number>; 2], String> {
        let (theta, d) = match row.turns() {
            true => (&row.offset, &row.d),
            false => (&row.theta, &row.offset),
        };
        let along = Pose::shift(self.list([None, None, d.as_ref()])?);
        let along = self.turn(2, theta.as_ref())?.then(&along);
        let across = Pose::shift(self.list([row.a.as_ref(), None, None])?)
            .then(&self.turn(0, row.alpha.as_ref())?);
        let none = Pose::shift([0i64; 3].map(Self::Number::from));
        match (convention, &row.placement) {
            (_, Some(placement)) => Ok([self.placement(Some(placement))?, none]),
            (Some("modified"), None) => Ok([across, along]),
            _ => {
                let tilted = across.then(&self.turn(1, row.beta.as_ref())?);
                Ok([none, along.then(&tilted)])
            }
        }
    }

    fn axis(&self, row: &Row) -> Result<[Self::Number; 3], String> {
        match &row.axis {
            Some(axis) => self.list(entries(Some(axis))),
            None => Ok([0i64, 0, 1].map(Self::Number::from)),
        }
    }
}

impl Reading for Point {
    type Number = Number;

    fn entry(&self, text: Option<&String>) -> Result<Number, String> {
        Ok(self.number(&number_of(text)?))
    }

    fn sines(&self, text: Option<&String>) -> Result<[Number; 2], String> {
        Ok(self.angle(&angle_of(text)?))
    }
}

impl Point {
    /// A base that floats stays where it is: in its axes nothing but gravity depends on that.
    fn floating(&self, file: &File, base: &FloatingBase) -> Result<Body, String> {
        let places = [&file.base, &file.tool, &file.payload_frame];
        let is_bare = base.com.is_none() || base.inertia.is_none();
        let has_mass = !number_of(Some(&base.mass))?.is_zero();
        if places.into_iter().any(Option::is_some) || file.convention.is_some() {
            return Err("a base that floats, beside a place of it or rows".into());
        }
        if is_bare && has_mass {
            return Err("the base: expected `com` and `inertia` beside a mass".into());
        }
        let (body, centre) = self.body(&base.mass, base.com.as_ref(), base.inertia.as_ref())?;
        Ok(body.moved(&centre))
    }

    fn line(&self, setting: &Setting, row: usize) -> Result<FollowerLine, String> {
        let follower = &setting.follows[row];
        let whole = |times: &Rational| times.to_i64().unwrap_or_default();
        let (mut pair, mut length) = ([0.into(), 1.into()], Number::from(0));
        for (factor, text) in &follower.offsets {
            if setting.file.joint[row].turns() {
                let angle = self.angle(&angle_of(Some(*text))?);
                pair = turned(pair, times(angle, whole(factor)));
            } else {
                length = length + self.number(&(number_of(Some(*text))? * factor));
            }
        }
        let place = setting.movers.iter().position(|row| *row == follower.row);
        let leader = place.ok_or("a joint follows one that does not move")?;
        let line = (whole(&follower.times), pair, length);
        Ok(((leader, self.number(&follower.times)), line))
    }
}

pub(super) fn entries<const K: usize>(list: Option<&[String; K]>) -> [Option<&String>; K] {
    from_fn(|k| list.map(|list| &list[k]))
}

impl Row {
    fn check(&self, convention: Option<&str>) -> Result<(), &'static str> {
        let is_zero = |text: &Option<String>| number_of(text.as_ref()).is_ok_and(|x| x.is_zero());
        let turns = self.turns();
        let variable = if turns { &self.theta } else { &self.d };
        let turned = [&self.alpha, &self.beta, &self.theta].map(is_zero);
        let shifted = [&self.a, &self.d, &self.offset].map(is_zero);
        let has_row = [turned, shifted].concat().contains(&false);
        let is_placed = self.placement.is_some();
        let is_bare = self.com.is_none() || self.inertia.is_none();
        let has_mass = !is_zero(&Some(self.mass.clone()));
        Err(if !turns && self.kind != "prismatic" {
            "expected `kind` revolute or prismatic"
        } else if self.mimic.is_some() && !is_zero(&self.coulomb) {
            "`coulomb` of a joint that follows another"
        } else if !is_zero(variable) {
            "`theta` of a revolute joint and `d` of a prismatic one must be 0"
        } else if convention != Some("standard") && !is_zero(&self.beta) {
            "`beta` is of standard rows alone"
        } else if is_placed && has_row {
            "a placement beside a row of the table"
        } else if is_placed != self.axis.is_some() {
            "expected `placement` and `axis`, or neither"
        } else if is_bare && has_mass {
            "expected `com` and `inertia` beside a mass"
        } else {
            return Ok(());
        })
    }
}

impl Arm {
    /// Returns a robot in its scene at a point of a field.
    ///
    /// # Errors
    /// The first text that is no number, or no angle, and a joint that the equations do not have.
    pub fn read(setting: &Setting, point: &Point) -> Result<Arm, String> {
        let (file, scene) = (setting.file, setting.scene);
        let convention = file.convention.as_deref();
        let base = point.placement(file.base.as_ref())?;
        let mut frame = base;
        let mut joints: Vec<Joint> = Vec::new();
        for (index, row) in file.joint.iter().enumerate() {
            let in_joint = |why: &str| format!("joint {}: {why}", index + 1);
            row.check(convention).map_err(in_joint)?;
            match (convention, &row.placement) {
                (Some("standard" | "modified"), None) | (None, Some(_)) => {}
                _ => return Err("expected `convention` and rows, or placements".into()),
            }
            let [before, behind] = point.ways(row, convention)?;
            let parent = file.carrier(index)?;
            let carrier = parent.map_or(base, |joint| joints[joint].link);
            let at = carrier.then(&before);
            frame = at.then(&behind);
            let along = point.axis(row)?;
            if dot(along, along).value(point.prime) != Some(1) {
                return Err(in_joint("`axis` is not a unit vector in the digits given"));
            }
            let turns = row.turns();
            let (body, centre) = point.body(&row.mass, row.com.as_ref(), row.inertia.as_ref())?;
            let centred_body = (body, frame.then(&centre));
            let drive = [&row.viscous, &row.coulomb, &row.armature];
            let [viscous, coulomb, armature] = point.list(drive.map(Option::as_ref))?;
            let (leader, line) = point.line(setting, index)?;
            let shown = frame.then(&point.placement(row.frame.as_ref())?);
            joints.push(Joint {
                parent,
                turns,
                leader,
                line,
                axis: at.screw(match turns {
                    true => Screw(along, Vector::default()),
                    false => Screw(Vector::default(), along),
                }),
                origin: match convention {
                    Some("standard") if row.frame.is_none() => (at.origin, false),
                    _ => (shown.origin, true),
                },
                link: frame,
                shown,
                body: body.moved(&centred_body.1),
                centred: centred_body,
                viscous,
                coulomb,
                armature,
            });
        }
        let gravity = scene.gravity.as_ref().unwrap_or(&file.gravity);
        let mut frames = Vec::new();
        if !file.is_tree() {
            let (name, row) = (HAND.to_owned(), joints.len().checked_sub(1));
            let pose = frame.then(&point.placement(file.tool.as_ref())?);
            frames.push(Frame { name, row, pose });
        }
        for named_frame in &file.frame {
            let (name, row) = (named_frame.name.clone(), file.frame_row(named_frame)?);
            let placed = point.placement(Some(&named_frame.placement()))?;
            let link = row.map_or(base, |row| joints[row].link);
            let pose = link.then(&placed);
            frames.push(Frame { name, row, pose });
        }
        let is_held = |coordinate: &usize| setting.is_held(*coordinate);
        let floating = file.floating.as_ref().filter(|_| setting.floats);
        let body = floating.map(|base| point.floating(file, base));
        let mut arm = Arm {
            base: body.transpose()?,
            movers: setting.movers.clone(),
            locked: (0..setting.sizes().coordinates).filter(is_held).collect(),
            gravity: point.list(entries(Some(gravity)))?,
            frames,
            joints,
            half: point.half(),
        };
        let carried = match &file.moved {
            Some(payload) => Some((payload, None)),
            None => (scene.payload.as_ref()).map(|payload| (payload, file.payload_frame.as_ref())),
        };
        if let Some((payload, frame)) = carried {
            let inertia = payload.inertia.as_ref();
            let (body, centre) = point.body(&payload.mass, Some(&payload.com), inertia)?;
            match file.holder(payload.link.as_ref())? {
                Some(row) => arm.carry(row, (body, centre), &point.placement(frame)?),
                None => {
                    let base = arm.base.ok_or("a payload on a base that does not move")?;
                    arm.base = Some(base.plus(&body.moved(&centre)));
                }
            }
        }
        Ok(arm)
    }

    /// Returns the arm as a coordinate of its base grows: where that is has no effect, and as it turns
    /// gravity turns the other way in its axes.
    pub(super) fn with_base_turned(&self, coordinate: usize) -> Arm {
        let mut arm = self.clone();
        if let Some(axis) = coordinate.checked_sub(3) {
            let mut turn = Vector::default();
            turn[axis] = Number::step(1);
            arm.gravity = sum(arm.gravity, cross(arm.gravity, turn));
        }
        arm
    }

    pub(super) fn base_coordinates(&self) -> usize {
        if self.base.is_some() { 6 } else { 0 }
    }

    /// Lists a row and those that carry its link, to the base.
    pub(super) fn way(&self, row: Option<usize>) -> impl Iterator<Item = usize> {
        successors(row, |&row| self.joints[row].parent)
    }

    /// Adds a body to a link, in a frame of that; the link's own is then both as one.
    pub(super) fn carry(&mut self, row: usize, (body, centre): (Body, Pose), frame: &Pose) {
        if let Some(link) = self.joints.get_mut(row) {
            let at = link.link.then(frame).then(&centre);
            link.body = link.body.plus(&body.moved(&at));
            let under = Number::from(1) / link.body.mass;
            let centre = scaled(under, link.body.first);
            let mut about = link.body.moved(&Pose::shift(opposite(centre)));
            about.first = Vector::default();
            link.centred = (about, Pose::shift(centre));
        }
    }

    /// Returns the parameters that base parameters add up: ten a link, about the origin and in the axes
    /// of its own frame, then armature and viscous friction of each row.
    pub(super) fn parameters(&self) -> Vec<Number> {
        let in_frame = |joint: &Joint| joint.body.moved(&joint.shown.inverse());
        let links = self.joints.iter().map(in_frame);
        let bodies = self.base.iter().copied().chain(links).flat_map(|body| {
            let [x, y, z] = body.first;
            let [[xx, xy, xz], [_, yy, yz], [_, _, zz]] = body.tensor;
            [body.mass, x, y, z, xx, yy, zz, xy, yz, xz]
        });
        let armatures = self.joints.iter().map(|joint| joint.armature);
        let viscous = self.joints.iter().map(|joint| joint.viscous);
        bodies.chain(armatures).chain(viscous).collect()
    }

    /// 1 where the axes of two joints that turn are parallel at q = 0, −1 where they are opposite.
    pub(crate) fn parallel(&self, joints: [usize; 2]) -> Option<f64> {
        let [a, b] = joints.map(|joint| self.joints[self.movers[joint]].axis.0);
        let is_zero = |number: Number| !number.is_nonzero();
        cross(a, b).into_iter().all(is_zero).then_some(())?;
        let is_same = is_zero(dot(a, b) - Number::from(1));
        Some(if is_same { 1.0 } else { -1.0 })
    }

    pub(super) fn spread(&self, rates: &[Number]) -> Vec<Number> {
        let base = self.base_coordinates();
        let rate = |joint: &Joint| rates[base + joint.leader.0] * joint.leader.1;
        self.joints.iter().map(rate).collect()
    }

    pub(super) fn gathered(&self, loads: impl IntoIterator<Item = Number>) -> Vec<Number> {
        let base = self.base_coordinates();
        let mut sums = vec![Number::default(); base + self.movers.len()];
        for (joint, load) in self.joints.iter().zip(loads) {
            let (leader, factor) = joint.leader;
            sums[base + leader] = sums[base + leader] + load * factor;
        }
        sums
    }
}
