//! The arm in base axes: where every joint's axis and every link's mass is at q = 0, and at a
//! state.
//!
//! A motion is (ω, v): the angular velocity, and the velocity of the point at the base's origin. A
//! wrench is (n, f): the moment about that origin, and the force. So motions, wrenches and masses
//! of all links add up without any frame between them.

use std::array::from_fn;

use num_traits::Zero;

use super::exact::{Angle, Point, number};
use super::number::Number;
use super::robot::{File, Placement, Row};

pub(super) type Vector = [Number; 3];

pub(super) fn sum(a: Vector, b: Vector) -> Vector {
    from_fn(|i| a[i] + b[i])
}

fn scaled(x: Number, a: Vector) -> Vector {
    a.map(|a| x * a)
}

fn opposite(a: Vector) -> Vector {
    a.map(|a| -a)
}

pub(super) fn dot(a: Vector, b: Vector) -> Number {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn cross(a: Vector, b: Vector) -> Vector {
    let [i, k] = [[1, 2, 0], [2, 0, 1]];
    from_fn(|axis| a[i[axis]] * b[k[axis]] - a[k[axis]] * b[i[axis]])
}

/// A motion (ω, v), or a wrench (n, f).
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Screw(pub(super) Vector, pub(super) Vector);

impl Screw {
    fn plus(self, other: Screw) -> Screw {
        Screw(sum(self.0, other.0), sum(self.1, other.1))
    }

    fn times(self, x: Number) -> Screw {
        Screw(scaled(x, self.0), scaled(x, self.1))
    }

    /// Returns the power of a wrench in this motion.
    pub(super) fn power(self, wrench: Screw) -> Number {
        dot(self.0, wrench.0) + dot(self.1, wrench.1)
    }

    /// Returns the rate of a motion that this one carries along.
    fn across(self, other: Screw) -> Screw {
        let linear = sum(cross(self.0, other.1), cross(self.1, other.0));
        Screw(cross(self.0, other.0), linear)
    }

    /// Returns the rate of a momentum that this motion carries along.
    fn across_momentum(self, other: Screw) -> Screw {
        let moment = sum(cross(self.0, other.0), cross(self.1, other.1));
        Screw(moment, cross(self.0, other.1))
    }
}

/// A turn R, by its columns, and a shift p: r ↦ R r + p.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pose {
    axes: [Vector; 3],
    pub(super) origin: Vector,
}

impl Pose {
    fn shift(origin: Vector) -> Pose {
        let axes = from_fn(|k| from_fn(|i| i64::from(i == k).into()));
        Pose { axes, origin }
    }

    /// Returns the turn about an axis of the frame, x being 0.
    fn turn(axis: usize, [sin, cos]: [Number; 2]) -> Pose {
        let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
        let mut pose = Pose::shift(Vector::default());
        (pose.axes[next][next], pose.axes[next][last]) = (cos, sin);
        (pose.axes[last][next], pose.axes[last][last]) = (-sin, cos);
        pose
    }

    fn rotate(&self, v: Vector) -> Vector {
        from_fn(|i| self.axes[0][i] * v[0] + self.axes[1][i] * v[1] + self.axes[2][i] * v[2])
    }

    pub(super) fn apply(&self, point: Vector) -> Vector {
        sum(self.rotate(point), self.origin)
    }

    pub(super) fn then(&self, next: &Pose) -> Pose {
        let axes = next.axes.map(|axis| self.rotate(axis));
        let origin = self.apply(next.origin);
        Pose { axes, origin }
    }

    fn screw(&self, own: Screw) -> Screw {
        let turned = self.rotate(own.0);
        Screw(turned, sum(self.rotate(own.1), cross(self.origin, turned)))
    }

    /// Returns [R | p], row by row.
    pub(super) fn rows(&self) -> Vec<Number> {
        let [x, y, z] = self.axes;
        let row = |i: usize| [x[i], y[i], z[i], self.origin[i]];
        (0..3).flat_map(row).collect()
    }

    /// Returns the motion of a joint, by a sine and a cosine or by a length.
    fn moved(axis: Screw, turns: bool, [sin, cos]: [Number; 2], slide: Number) -> Pose {
        if !turns {
            return Pose::shift(scaled(slide, axis.1));
        }
        // r ↦ c r + s ω × r + (1 − c) ω (ω·r), about the point ω × v of the axis.
        let about = |r: Vector| {
            let along = scaled((Number::from(1) - cos) * dot(axis.0, r), axis.0);
            sum(sum(scaled(cos, r), scaled(sin, cross(axis.0, r))), along)
        };
        let point = cross(axis.0, axis.1);
        let mut pose = Pose::shift(point);
        pose.axes = pose.axes.map(about);
        pose.origin = sum(point, opposite(pose.rotate(point)));
        pose
    }
}

/// Mass, first moment and the tensor of inertia about the origin.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Body {
    pub(super) mass: Number,
    pub(super) first: Vector,
    pub(super) tensor: [Vector; 3],
}

impl Body {
    /// Returns a body of m, m x, m y, m z, xx, yy, zz, xy, yz and xz.
    pub(super) fn new([mass, x, y, z, xx, yy, zz, xy, yz, xz]: [Number; 10]) -> Body {
        let tensor = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
        let first = [x, y, z];
        Body {
            mass,
            first,
            tensor,
        }
    }

    fn plus(&self, other: &Body) -> Body {
        Body {
            mass: self.mass + other.mass,
            first: sum(self.first, other.first),
            tensor: from_fn(|i| sum(self.tensor[i], other.tensor[i])),
        }
    }

    /// Returns the body moved by a pose.
    pub(super) fn moved(&self, pose: &Pose) -> Body {
        let (p, turned) = (pose.origin, pose.rotate(self.first));
        // R I Rᵀ, then Steiner from the old origin to the new one.
        let half = self.tensor.map(|row| pose.rotate(row));
        let twice = dot(p, turned) + dot(p, turned) + self.mass * dot(p, p);
        let entry = |i: usize, k: usize| {
            let column = [0, 1, 2].map(|j: usize| half[j][k]);
            let row = [0, 1, 2].map(|j: usize| pose.axes[j][i]);
            let across = p[i] * turned[k] + turned[i] * p[k] + self.mass * p[i] * p[k];
            dot(row, column) - across + if i == k { twice } else { 0.into() }
        };
        Body {
            mass: self.mass,
            first: sum(turned, scaled(self.mass, p)),
            tensor: from_fn(|i| from_fn(|k| entry(i, k))),
        }
    }

    /// Returns the momentum of a motion.
    fn momentum(&self, motion: Screw) -> Screw {
        let spin = self.tensor.map(|row| dot(row, motion.0));
        let force = sum(scaled(self.mass, motion.1), cross(motion.0, self.first));
        Screw(sum(spin, cross(self.first, motion.1)), force)
    }
}

/// A joint and its link, at q = 0 in base axes.
#[derive(Clone, Debug)]
pub struct Joint {
    turns: bool,
    axis: Screw,
    /// The origin of the frame whose z the axis is, and whether the joint moves it.
    pub(super) origin: (Vector, bool),
    /// The link's frame of the table.
    pub(super) link: Pose,
    /// The link's frame in `link_poses`.
    pub(super) shown: Pose,
    /// The link's mass.
    pub(super) body: Body,
    /// The body about its centre of mass, and where that is.
    pub(super) given: (Body, Pose),
    /// Viscous friction, N·m·s/rad or N·s/m.
    pub viscous: Number,
    /// The inertia of the drive as the joint feels it, kg·m² or kg.
    pub armature: Number,
}

/// An arm at q = 0.
#[derive(Clone, Debug)]
pub struct Arm {
    /// The joints, from the base outward.
    pub joints: Vec<Joint>,
    /// The acceleration of gravity, m/s².
    pub(super) gravity: Vector,
    /// The hand.
    pub(super) hand: Pose,
    /// One half, in this field.
    pub half: Number,
}

impl Point {
    /// Returns numbers, of which missing ones are zero.
    fn list<const K: usize>(&self, list: [Option<&String>; K]) -> Result<[Number; K], String> {
        let mut all = [Number::default(); K];
        for (one, text) in all.iter_mut().zip(list) {
            if let Some(text) = text {
                *one = self.number(&number(text).ok_or_else(|| format!("`{text}` is no number"))?);
            }
        }
        Ok(all)
    }

    fn turn(&self, axis: usize, text: Option<&String>) -> Result<Pose, String> {
        let text = text.map_or("0", String::as_str);
        let angle = Angle::read(text).ok_or_else(|| format!("`{text}` is no angle"))?;
        Ok(Pose::turn(axis, self.angle(&angle)))
    }

    fn placement(&self, own: Option<&Placement>) -> Result<Pose, String> {
        let own = own.cloned().unwrap_or_default();
        let [xyz, rpy] = [&own.xyz, &own.rpy].map(|list| entries(list.as_ref()));
        let mut pose = Pose::shift(self.list(xyz)?);
        for axis in [2, 1, 0] {
            pose = pose.then(&self.turn(axis, rpy[axis])?);
        }
        Ok(pose)
    }

    /// Returns the ways before and behind a joint's axis.
    fn ways(&self, row: &Row, convention: Option<&str>) -> Result<[Pose; 2], String> {
        let (theta, d) = match row.kind == "revolute" {
            true => (&row.offset, &row.d),
            false => (&row.theta, &row.offset),
        };
        let along = Pose::shift(self.list([None, None, d.as_ref()])?);
        let along = self.turn(2, theta.as_ref())?.then(&along);
        let across = Pose::shift(self.list([row.a.as_ref(), None, None])?);
        let across = across.then(&self.turn(0, row.alpha.as_ref())?);
        let none = Pose::shift(Vector::default());
        match (convention, &row.placement) {
            (Some("standard"), None) => {
                let tilted = across.then(&self.turn(1, row.beta.as_ref())?);
                Ok([none, along.then(&tilted)])
            }
            (Some("modified"), None) => Ok([across, along]),
            (None, Some(placement)) => Ok([self.placement(Some(placement))?, none]),
            _ => Err("expected `convention` and rows, or placements".into()),
        }
    }
}

fn entries<const K: usize>(list: Option<&[String; K]>) -> [Option<&String>; K] {
    from_fn(|k| list.map(|list| &list[k]))
}

impl Row {
    /// Refuses a joint that the equations do not have, or with a key that they would not read.
    fn check(&self, convention: Option<&str>) -> Result<(), &'static str> {
        let is_zero = |text: &Option<String>| {
            let value = text.as_ref().map(|text| number(text));
            value.is_none_or(|value| value.is_some_and(|value| value.is_zero()))
        };
        let turns = self.kind == "revolute";
        let variable = if turns { &self.theta } else { &self.d };
        let turned = [&self.alpha, &self.beta, &self.theta].map(is_zero);
        let shifted = [&self.a, &self.d, &self.offset].map(is_zero);
        let has_row = [turned, shifted].concat().contains(&false);
        let is_placed = self.placement.is_some();
        let is_bare = self.com.is_none() || self.inertia.is_none();
        let has_mass = !is_zero(&Some(self.mass.clone()));
        Err(if !turns && self.kind != "prismatic" {
            "expected `kind` revolute or prismatic"
        } else if self.mimic.is_some() {
            "`mimic` is not compared yet"
        } else if !is_zero(&self.coulomb) {
            "`coulomb` is not compared yet"
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
    /// Returns the arm of a robot file at a point of a field.
    ///
    /// # Errors
    /// The first text that is no number, or no angle, and a joint that the equations do not have.
    pub fn read(file: &File, point: &Point) -> Result<Arm, String> {
        let mut frame = point.placement(file.base.as_ref())?;
        let mut joints = Vec::new();
        for (index, row) in file.joint.iter().enumerate() {
            let in_joint = |why: &str| format!("joint {}: {why}", index + 1);
            row.check(file.convention.as_deref()).map_err(in_joint)?;
            let [before, behind] = point.ways(row, file.convention.as_deref())?;
            let at = frame.then(&before);
            frame = at.then(&behind);
            let along = match &row.axis {
                Some(axis) => point.list(entries(Some(axis)))?,
                None => [0.into(), 0.into(), 1.into()],
            };
            if dot(along, along).value(point.prime) != Some(1) {
                return Err(in_joint("`axis` is no unit vector in the digits given"));
            }
            let turns = row.kind == "revolute";
            let [mass] = point.list([Some(&row.mass)])?;
            let [xx, yy, zz, xy, yz, xz] = point.list(entries(row.inertia.as_ref()))?;
            let none = Number::default();
            let given = Body::new([mass, none, none, none, xx, yy, zz, xy, yz, xz]);
            let centre = Pose::shift(point.list(entries(row.com.as_ref()))?);
            let centre = frame.then(&centre);
            let drive = [row.viscous.as_ref(), row.armature.as_ref()];
            let [viscous, armature] = point.list(drive)?;
            joints.push(Joint {
                turns,
                axis: at.screw(match turns {
                    true => Screw(along, Vector::default()),
                    false => Screw(Vector::default(), along),
                }),
                origin: match file.convention.as_deref() {
                    Some("standard") => (at.origin, false),
                    _ => (frame.origin, true),
                },
                link: frame,
                shown: frame.then(&point.placement(row.frame.as_ref())?),
                body: given.moved(&centre),
                given: (given, centre),
                viscous,
                armature,
            });
        }
        Ok(Arm {
            joints,
            gravity: point.list(entries(Some(&file.gravity)))?,
            hand: frame.then(&point.placement(file.tool.as_ref())?),
            half: Number::new(point.prime / 2 + 1, point.prime),
        })
    }

    /// Returns the arm with other bodies.
    pub(super) fn with(&self, body: impl Fn(usize, &Joint) -> Body) -> Arm {
        let mut arm = self.clone();
        for (k, own) in arm.joints.iter_mut().enumerate() {
            own.body = body(k, own);
        }
        arm
    }

    /// Returns the arm at the sines and cosines, or the lengths, of its joints.
    pub(super) fn at(&self, pairs: &[[Number; 2]], slides: &[Number]) -> Placed {
        let mut placed = Placed::default();
        let mut pose = Pose::shift(Vector::default());
        for ((joint, pair), slide) in self.joints.iter().zip(pairs).zip(slides) {
            placed.axes.push(pose.screw(joint.axis));
            placed.before.push(pose);
            pose = pose.then(&Pose::moved(joint.axis, joint.turns, *pair, *slide));
            placed.poses.push(pose);
            placed.bodies.push(joint.body.moved(&pose));
        }
        placed
    }
}

/// An arm at a state: each joint's axis, what its link has moved by, and its link's mass.
#[derive(Clone, Debug, Default)]
pub(super) struct Placed {
    pub(super) axes: Vec<Screw>,
    pub(super) before: Vec<Pose>,
    pub(super) poses: Vec<Pose>,
    pub(super) bodies: Vec<Body>,
}

impl Placed {
    /// Returns the velocity and the acceleration of each link, from that of the base.
    pub(super) fn motions(&self, qd: &[Number], qdd: &[Number], base: Vector) -> Vec<[Screw; 2]> {
        let (mut v, mut a) = (Screw::default(), Screw(Vector::default(), base));
        let rates = self.axes.iter().zip(qd).zip(qdd);
        let motions = rates.map(|((axis, qd), qdd)| {
            let own = axis.times(*qd);
            a = a.plus(axis.times(*qdd)).plus(v.across(own));
            v = v.plus(own);
            [v, a]
        });
        motions.collect()
    }

    /// Returns the wrench that each joint passes on, by the equations of Newton and Euler.
    pub(super) fn wrenches(&self, qd: &[Number], qdd: &[Number], gravity: Vector) -> Vec<Screw> {
        // A base that is accelerated upward feels what one in gravity does.
        let motions = self.motions(qd, qdd, opposite(gravity));
        let links = self.bodies.iter().zip(motions);
        let wrenches = links.map(|(body, [v, a])| {
            let turned = v.across_momentum(body.momentum(v));
            body.momentum(a).plus(turned)
        });
        let mut wrenches: Vec<Screw> = wrenches.collect();
        let mut all = Screw::default();
        for wrench in wrenches.iter_mut().rev() {
            all = all.plus(*wrench);
            *wrench = all;
        }
        wrenches
    }

    /// Returns D without armature: D_ik is the power in motion i of the momentum that motion k
    /// gives all links from the further one on.
    pub(super) fn inertia(&self) -> Vec<Vec<Number>> {
        let n = self.axes.len();
        let (mut d, mut all) = (vec![vec![Number::default(); n]; n], Body::default());
        for k in (0..n).rev() {
            all = all.plus(&self.bodies[k]);
            let momentum = all.momentum(self.axes[k]);
            for (i, axis) in self.axes[..=k].iter().enumerate() {
                d[k][i] = axis.power(momentum);
                d[i][k] = d[k][i];
            }
        }
        d
    }
}
