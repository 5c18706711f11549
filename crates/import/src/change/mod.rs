//! Bounds of the changes in torques and hand pose by snapping.
//!
//! The recursion of Newton and Euler over the joints' own frames, with sizes for
//! vectors: the length that a vector has at most, of either arm, and how far the two
//! arms' vectors are apart. For sums both add up; of a product, |a₂ b₂ − a₁ b₁| ≤
//! |a₂||b₂ − b₁| + |a₂ − a₁||b₁|. A turn keeps lengths, and two turns move a vector
//! apart by its length times the distance of the turns. So every position of the
//! joints is covered, and with upward rounding the result is a bound, not a
//! measurement. The triangle inequality makes it fifty to a hundred and fifty times
//! what 25 states of real arms show. The hand's pose is bounded by the same sizes along
//! the chain, which makes two to three times what those states show. What is computed
//! for the file, bodies that are merged and rows that are derived, is rounded to 20
//! digits beside it.

mod pair;

use std::fmt;

use dalembert_model::number::{Rational, Rounded, Wide};
use dalembert_model::placed::frame::pose;
use dalembert_model::robot::Position;
use num_traits::Signed;

use crate::Options;
use crate::merge::{Branch, Tree};
use crate::model::{Kind, Model, Number, positive};
use pair::{Pair, next_up_unless_zero, root_of_squares, upward, vectors};

/// √3, not below.
const ROOT_3: f64 = 1.7320508075688774;

/// Bounds of how far torques and pose of the snapped arm are from those of the URDF's digits.
#[derive(Clone, Debug)]
pub struct Change {
    links: Vec<Parts>,
    /// The ends, each with its body, and from there: how far it is, and how it is turned.
    ends: Vec<(usize, [Pair; 2])>,
    limits: Motion,
    /// The sizes of ω, ω̇ and v̇ of the base, the same of both: that of gravity, and those of a base
    /// that floats.
    base: [f64; 3],
    efforts: Option<Vec<f64>>,
}

/// The motion that a bound is over: at most so far, so fast, so steeply.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    /// |q| of joints that slide, m; those that turn may be anywhere.
    pub position: Vec<f64>,
    /// |q̇|, rad/s or m/s.
    pub velocity: Vec<f64>,
    /// |q̈|, rad/s² or m/s².
    pub acceleration: Vec<f64>,
}

/// A bound of how far the hand of the snapped arm is from that of the URDF's digits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Displacement {
    /// m
    pub position: f64,
    /// The angle by which it is turned, rad.
    pub angle: f64,
}

#[derive(Clone, Debug)]
struct Parts {
    /// The body that it hangs on; none where that is the base.
    parent: Option<usize>,
    slides: bool,
    turn: Pair,
    axis: Pair,
    lever: Pair,
    mass: Pair,
    com: Pair,
    inertia: Pair,
}

impl Change {
    /// Returns the motion within the model's limits; where it has none, ±1 m, 3 per second
    /// and the acceleration of the options, or 10.
    pub fn limits(&self) -> &Motion {
        &self.limits
    }

    /// Returns bounds of the torques' changes over a motion, N·m or N; joints
    /// beyond the motion's are taken not to move.
    pub fn torques(&self, motion: &Motion) -> Vec<f64> {
        let torques = self.pairs(motion).into_iter();
        torques.map(|torque| torque.off).collect()
    }

    fn pairs(&self, motion: &Motion) -> Vec<Pair> {
        let value =
            |values: &[f64], i: usize| Pair::of(values.get(i).copied().unwrap_or(0.0).abs());
        // ω, ω̇ and v̇ of each body.
        let base = self.base.map(Pair::of);
        let mut motions: Vec<[Pair; 3]> = Vec::with_capacity(self.links.len());
        let mut loads = Vec::with_capacity(self.links.len());
        for (i, part) in self.links.iter().enumerate() {
            let [q, qd, qdd] = [&motion.position, &motion.velocity, &motion.acceleration]
                .map(|values| value(values, i));
            let lever = part.lever_at(q);
            let [omega, turning, moving] = part.parent.map_or(base, |parent| motions[parent]);
            let carried = moving + turning * lever + omega * omega * lever;
            let (before, along) = (part.turn * omega, part.axis * qd);
            let mut moving = part.turn * carried;
            let mut turning = part.turn * turning;
            let mut omega = before;
            if part.slides {
                let coriolis = before * along;
                moving = moving + part.axis * qdd + coriolis + coriolis;
            } else {
                turning = turning + part.axis * qdd + before * along;
                omega = before + along;
            }
            let of_com = moving + turning * part.com + omega * omega * part.com;
            let force = part.mass * of_com;
            let moment = part.inertia * turning + omega * part.inertia * omega + part.com * force;
            motions.push([omega, turning, moving]);
            loads.push((lever, force, moment));
        }
        let mut torques = Vec::with_capacity(self.links.len());
        for (i, part) in self.links.iter().enumerate().rev() {
            let (lever, force, moment) = loads[i];
            torques.push(part.axis * if part.slides { force } else { moment });
            // From this joint's frame into that of the body it hangs on.
            if let Some(parent) = part.parent {
                let (_, parent_force, parent_moment) = &mut loads[parent];
                let carried = part.turn * force;
                *parent_moment = *parent_moment + part.turn * moment + lever * carried;
                *parent_force = *parent_force + carried;
            }
        }
        torques.reverse();
        torques
    }

    /// Returns how far the hand may be off over a motion, in the base: of several ends, the most
    /// that one of them is.
    pub fn hand(&self, motion: &Motion) -> Displacement {
        let mut poses: Vec<[Pair; 2]> = Vec::with_capacity(self.links.len());
        for (i, part) in self.links.iter().enumerate() {
            let q = motion.position.get(i).copied().unwrap_or(0.0).abs();
            let base = [Pair::ZERO, Pair::of(1.0)];
            let [at, turn] = part.parent.map_or(base, |parent| poses[parent]);
            poses.push([at + turn * part.lever_at(Pair::of(q)), turn * part.turn]);
        }
        let most = |off: fn([Pair; 2], [Pair; 2]) -> f64| {
            let ends = self.ends.iter();
            let offs = ends.map(|(body, tool)| off(poses[*body], *tool));
            offs.fold(0.0, f64::max)
        };
        Displacement {
            position: most(|[at, turn], [lever, _]| (at + turn * lever).off),
            angle: most(|[_, turn], [_, turned]| angle((turn * turned).off)),
        }
    }

    /// Returns a bound as text, two digits, not below.
    pub fn in_digits(bound: f64) -> String {
        upward(bound)
    }

    /// Returns the largest of them within the limits, each relative to the joint's effort, or to the
    /// bound of the torque itself where that is not known.
    pub fn relative(&self) -> f64 {
        let torques = self.pairs(&self.limits);
        let effort = |i: usize| self.efforts.as_ref().map(|efforts| efforts[i]);
        let parts = torques.iter().enumerate().map(|(i, torque)| {
            let part = torque.off / effort(i).unwrap_or(torque.size);
            if torque.off == 0.0 { 0.0 } else { part }
        });
        parts.fold(0.0, f64::max)
    }

    /// Returns the largest of them within the limits, relative to the joint's effort, if
    /// every joint has one.
    pub fn of_efforts(&self) -> Option<f64> {
        let torques = self.torques(&self.limits);
        let efforts = self.efforts.as_ref()?.iter();
        let parts = torques.iter().zip(efforts);
        Some(parts.fold(0.0, |most: f64, (off, effort)| {
            most.max(next_up_unless_zero(off / effort))
        }))
    }
}

/// `≤ 3.1e-9 of the effort limits`
impl fmt::Display for Change {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (worst, of) = match self.of_efforts() {
            Some(part) => (part, "of the effort limits"),
            None => {
                let torques = self.torques(&self.limits).into_iter();
                (torques.fold(0.0, f64::max), "N·m or N")
            }
        };
        match worst == 0.0 {
            true => f.write_str("nothing"),
            false => write!(f, "≤ {} {of}", upward(worst)),
        }
    }
}

impl Parts {
    /// From the frame before to this one's origin, where the joint is at most `q` out.
    fn lever_at(&self, q: Pair) -> Pair {
        match self.slides {
            true => self.lever + self.turn * self.axis * q,
            false => self.lever,
        }
    }
}

/// Returns by how much two turns differ that move no unit vector further apart than this: that
/// chord belongs to 2 asin(x/2), which is less than x + x³/20 up to one.
fn angle(chord: f64) -> f64 {
    match chord < 0.99 {
        true => next_up_unless_zero(chord * (1.0 + chord * chord / 20.0).next_up().next_up()),
        false => std::f64::consts::PI.next_up(),
    }
}

pub(crate) fn bound(written: &Tree, snapped: &Tree, model: &Model, options: &Options) -> Change {
    let bodies = &snapped.bodies;
    let joints = || bodies.iter().map(|branch| &model.joints[branch.joint]);
    let pairs = written.bodies.iter().zip(&snapped.bodies).zip(joints());
    let links = pairs.map(|((one, other), joint)| parts(one, other, joint.kind == Kind::Prismatic));
    let upper = |value: &Rational| f64::nearest_rational(&value.abs()).next_up();
    let limit_or = |limit: &Option<Number>, otherwise: f64| {
        positive(limit).map_or(otherwise, |limit| upper(&limit.value))
    };
    let otherwise = options.acceleration.as_ref().map_or(10.0, upper);
    let velocity = joints().map(|joint| limit_or(&joint.velocity, 3.0));
    let acceleration = joints().map(|joint| limit_or(&joint.acceleration, otherwise));
    let position = joints().map(|joint| {
        let sizes = joint.position.iter().flatten().map(|end| match &end.value {
            Position::Length(length) => upper(length),
            Position::Angle(_) => 0.0,
        });
        sizes.reduce(f64::max).unwrap_or(1.0)
    });
    let limits = Motion {
        position: position.collect(),
        velocity: velocity.collect(),
        acceleration: acceleration.collect(),
    };
    let least = |value: &Number| f64::nearest_rational(&value.value).next_down();
    let efforts = joints().map(|joint| positive(&joint.effort).map(least));
    let ends = written.ends.iter().zip(&snapped.ends).map(|(one, other)| {
        let tools = [one, other].map(|(_, tool)| pose(tool));
        let turned = [0, 1, 2].map(|k| vectors(&tools[0].axes[k], &tools[1].axes[k]).off);
        let turned = Pair::new(1.0, root_of_squares(&turned));
        (one.0, [vectors(&tools[0].origin, &tools[1].origin), turned])
    });
    let gravity = model.gravity.as_ref().map_or(9.81, |gravity| {
        root_of_squares(&gravity.each_ref().map(|x| upper(&x.value)))
    });
    // Each component at most as of joints without limits: of three, and of ω × v.
    let (speed, rise) = (3.0 * ROOT_3, otherwise * ROOT_3);
    let base = match snapped.base {
        None => [0.0, 0.0, gravity],
        Some(_) => [speed, rise, gravity + rise + speed * speed].map(f64::next_up),
    };
    Change {
        limits,
        base,
        ends: ends.collect(),
        efforts: efforts.collect(),
        links: links.collect(),
    }
}

fn parts(one: &Branch, other: &Branch, slides: bool) -> Parts {
    let axes = [0, 1, 2].map(|k| vectors(&one.pose.axes[k], &other.pose.axes[k]).off);
    let placed = root_of_squares(&axes);
    let axis = Pair::new(1f64.next_up(), vectors(&one.axis, &other.axis).off);
    // Turns about two unit vectors: s [u]× + (1 − c) u uᵀ differ by no more than
    // |δu| + 2 · 2 |δu|.
    let turned = match slides {
        true => 0.0,
        false => next_up_unless_zero(5.0 * axis.off),
    };
    let wide = |values: &[Rational; 3]| values.each_ref().map(Wide::from_rational);
    let [tensor, other_tensor] = [one, other].map(|link| link.body.inertia.rows());
    let rows = [0, 1, 2].map(|i| vectors(&wide(&tensor[i]), &wide(&other_tensor[i])));
    let mass = f64::nearest_rational(&one.body.mass.abs()).next_up();
    Parts {
        parent: one.parent,
        slides,
        turn: Pair::new(1.0, next_up_unless_zero(placed + turned)),
        axis,
        lever: vectors(&one.pose.origin, &other.pose.origin),
        mass: Pair::new(mass, 0.0),
        com: vectors(&wide(&one.body.com), &wide(&other.body.com)),
        inertia: Pair::new(
            root_of_squares(&rows.map(|row| row.size)),
            root_of_squares(&rows.map(|row| row.off)),
        ),
    }
}
