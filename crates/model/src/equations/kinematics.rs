//! Poses, velocities and loads of links.
//!
//! Lagrange–Euler takes rates of the poses themselves, by dual numbers; the
//! other formulations use axes and levers. Nothing is shared but eq. 2.1.

use alloc::vec::Vec;

use super::arm::{Posed, Step};
use super::derivatives::with_rates;
use super::energy::moving;
use super::factor::{picked, placed};
use super::frames::Axes;
use super::lagrange_euler::PseudoInertia;
use super::matrix::*;
use super::newton_euler::{FrameMotion, table1};
use super::screws::Wrench;
use super::{Arm, At, Formulation, joint_axes};
use crate::robot::{Convention, JointKind};
use crate::scalar::Scalar;
use crate::scalar::dual::Dual;

/// Returns ⁰A_i of every frame i = 1 … n, in base axes.
pub fn poses<S: Scalar>(arm: &Arm<S>, at: &At<S>) -> Vec<Columns<S>> {
    poses_from(&arm.frame_0(), arm, at)
}

/// Returns the pose of every link's own frame, in base axes.
pub fn link_poses<S: Scalar>(arm: &Arm<S>, at: &At<S>) -> Vec<Columns<S>> {
    let of_rows = poses(arm, at).into_iter().enumerate();
    let poses = of_rows.map(|(link, pose)| match arm.frames.of_link(link) {
        None => pose,
        Some(frame) => pose.then(frame),
    });
    poses.collect()
}

fn poses_from<S: Scalar>(start: &Columns<S>, arm: &Arm<S>, at: &At<S>) -> Vec<Columns<S>> {
    arm.outward(start, |link, before| arm.step(link, at).append(before))
}

pub(super) fn hand_of<S: Scalar>(arm: &Arm<S>, poses: &[Columns<S>]) -> Columns<S> {
    let last = poses.last().cloned().unwrap_or_else(|| arm.frame_0());
    match &arm.tool {
        None => last,
        Some(tool) => last.then(tool),
    }
}

pub(super) fn at_lever<S: Scalar>(arm: &Arm<S>, hand: Columns<S>, lever: Vector<S>) -> Columns<S> {
    let origin = match &arm.base {
        None => lever,
        Some(base) => sum(&base.origin, &lever),
    };
    Columns { origin, ..hand }
}

impl Formulation {
    /// Returns the pose of the hand, ⁰A_n but for base and tool: the recursions in link axes go from
    /// the hand inward, which is less work, with three axes or with two; Lagrange–Euler multiplies
    /// outward; the others add the levers of a Jacobian, in base axes or in the joints' own.
    pub fn hand<S: Scalar>(self, arm: &Arm<S>, at: &At<S>) -> Columns<S> {
        let (arm, at) = arm.to_hand(at);
        let (arm, at) = (&*arm, &*at);
        match self {
            Self::LagrangeEuler => hand_of(arm, &poses(arm, at)),
            Self::Dalembert => hand_by_levers(arm, at),
            Self::NewtonEulerBase => joint_axes::hand(arm, at),
            Self::NewtonEulerLink | Self::NewtonEulerLinkDifferences => hand_inward(arm, at),
            Self::NewtonEulerLinkAsPrinted => hand_by_two_axes(arm, at),
        }
    }

    /// Returns J, 6×n, the linear over the angular velocity of the hand, in the arm's [`Axes`].
    pub fn jacobian<S: Scalar>(self, arm: &Arm<S>, at: &At<S>) -> Matrix<S> {
        let (n, way) = (at.len(), arm.way_to_hand());
        let (arm, at) = arm.to_hand(at);
        let at = &*at;
        let columns = match (arm.frames.axes, self) {
            (Axes::Local, Self::NewtonEulerLink | Self::NewtonEulerLinkDifferences) => {
                local_columns(&arm, at)
            }
            (axes, _) => {
                let columns = self.mixed_columns(&arm, at).into_iter();
                let hand = (axes != Axes::Mixed).then(|| self.hand(&arm, at));
                let turned = |column| in_axes(axes, hand.as_ref(), column);
                columns.map(turned).collect()
            }
        };
        let nothing = alloc::vec![[zero_vector(), zero_vector()]; n];
        let columns = placed(nothing, &way, columns);
        matrix(6, n, |r, j| columns[j][r / 3][r % 3].clone())
    }

    fn mixed_columns<S: Scalar>(self, arm: &Arm<S>, at: &At<S>) -> Vec<[Vector<S>; 2]> {
        match self {
            Self::LagrangeEuler => (0..at.len()).map(|j| by_rates(arm, at, j)).collect(),
            Self::NewtonEulerBase => joint_axes::columns(arm, at),
            Self::NewtonEulerLinkAsPrinted => joint_axes::columns_across(arm, at),
            _ => {
                let levers = levers(arm, at);
                (0..at.len()).map(|j| by_lever(arm, &levers, j)).collect()
            }
        }
    }

    /// Returns J̇ q̇, linear over angular, in the arm's [`Axes`]: the rate of J q̇ in a motion that
    /// keeps its velocities. In base axes at the hand it is the hand's acceleration, which in those
    /// of a base that floats is no rate of components.
    pub fn jacobian_rate<S: Scalar>(self, arm: &Arm<S>, at: &At<S>, qd: &[S]) -> [Vector<S>; 2] {
        let qd = &picked(qd, &arm.way_to_hand())[..];
        let (arm, at) = arm.to_hand(at);
        let at = &*at;
        let rate = self.bias_acceleration(&arm, at, [qd, &arm.accelerations(qd, &zeros(qd.len()))]);
        let axes = arm.frames.axes;
        if axes == Axes::Mixed {
            return rate;
        }
        // The frame's point moves on: v × ω, in base axes.
        let mut twist = [zero_vector(), zero_vector()];
        for (column, qd) in self.mixed_columns(&arm, at).iter().zip(qd) {
            twist = [0, 1].map(|part| sum(&twist[part], &scaled(qd, &column[part])));
        }
        let [linear, angular] = rate;
        let of_point = sum(&linear, &cross(&twist[0], &twist[1]));
        in_axes(axes, Some(&self.hand(&arm, at)), [of_point, angular])
    }

    fn bias_acceleration<S: Scalar>(
        self,
        arm: &Arm<S>,
        at: &At<S>,
        [qd, qdd]: [&[S]; 2],
    ) -> [Vector<S>; 2] {
        if self != Self::LagrangeEuler {
            let arm = arm.weightless();
            let base = FrameMotion::of_base(&arm.gravity);
            let rate = table1::tip_acceleration(&arm, at, [qd, qdd], &base);
            return match &arm.base {
                None => rate,
                Some(base) => rate.each_ref().map(|part| base.rotate(part)),
            };
        }
        let (arm, at) = accelerated(arm, at, qd, qdd);
        let hand = hand_of(&arm, &poses(&arm, &at));
        let linear = hand.origin.each_ref().map(|x| x.rate.rate.clone());
        [linear, angular(&hand).map(|omega| omega.rate)]
    }

    /// Returns the wrench of link i−1 on link i, gravity included, in base axes;
    /// the moment about the origin of frame i−1, or of frame i in modified DH.
    pub fn wrenches<S: Scalar>(self, arm: &Arm<S>, at: &At<S>, rates: [&[S]; 2]) -> Vec<Wrench<S>> {
        let [qd, qdd] = rates;
        let qdd = &*arm.accelerations(qd, qdd);
        let wrenches = match self {
            Self::LagrangeEuler => wrenches_by_poses(arm, at, qd, qdd),
            _ => table1::wrenches(arm, at, qd, qdd),
        };
        let Some(base) = &arm.base else {
            return wrenches;
        };
        let turned = |wrench: &Wrench<S>| wrench.in_axes(|v| base.rotate(v));
        wrenches.iter().map(turned).collect()
    }

    /// Returns [`wrenches`](Formulation::wrenches), but where a link has a frame of its own the moment is
    /// about the origin of that: rows of placed joints have their origins anywhere on the axes.
    pub fn reactions<S: Scalar>(
        self,
        arm: &Arm<S>,
        at: &At<S>,
        rates: [&[S]; 2],
    ) -> Vec<Wrench<S>> {
        let mut wrenches = self.wrenches(arm, at, rates);
        if (0..wrenches.len()).all(|link| arm.frames.of_link(link).is_none()) {
            return wrenches;
        }
        let (poses, base) = (poses(arm, at), arm.frame_0());
        for ((link, step), wrench) in arm.steps(at).enumerate().zip(&mut wrenches) {
            let Some(frame) = arm.frames.of_link(link) else {
                continue;
            };
            let lever = match arm.convention {
                Convention::Modified => poses[link].rotate(&frame.origin),
                Convention::Standard => {
                    // The step's own origin is the lever: no difference of two large positions.
                    let before = arm.carrier(link).map_or(&base, |carrier| &poses[carrier]);
                    let turned = Columns::turned(before.axes.clone());
                    step.append(&turned).then(frame).origin
                }
            };
            wrench.moment = difference(&wrench.moment, &cross(&lever, &wrench.force));
        }
        wrenches
    }
}

/// Returns the wrenches in the axes of frame 0, as gravity is.
fn wrenches_by_poses<S: Scalar>(arm: &Arm<S>, at: &At<S>, qd: &[S], qdd: &[S]) -> Vec<Wrench<S>> {
    let (arm_moving, at_moving) = accelerated(arm, at, qd, qdd);
    let moving = poses_from(&Columns::identity(), &arm_moving, &at_moving);
    let still = poses_from(&Columns::identity(), arm, at);
    arm.inward(|i, arrived: Vec<(usize, Wrench<S>)>| {
        let others = arrived.iter();
        let carried = others.fold(Wrench::zero(), |total, (_, wrench)| total.with(wrench));
        let about_base = carried.with(&inertial(arm, i, &still[i], &moving[i]));
        let Wrench { force, moment } = about_base.clone();
        let point = match (arm.convention, i) {
            (Convention::Modified, _) => still[i].origin.clone(),
            (Convention::Standard, 0) => zero_vector(),
            (Convention::Standard, _) => still[i - 1].origin.clone(),
        };
        let moment = difference(&moment, &cross(&point, &force));
        (about_base, Wrench { force, moment })
    })
}

type Twice<S> = Dual<Dual<S>>;

fn accelerated<S: Scalar>(arm: &Arm<S>, at: &At<S>, qd: &[S], qdd: &[S]) -> Posed<Twice<S>> {
    let (arm, at) = moving(arm, at, qd);
    moving(&arm, &at, &with_rates(qd, qdd))
}

/// Returns ω of a frame: Ṙ Rᵀ is skew.
fn angular<S: Scalar>(frame: &Columns<Dual<S>>) -> Vector<S> {
    let entry = |row: usize, column: usize| {
        let axes = frame.axes.iter();
        total(axes.map(|axis| times(&axis[row].rate, &axis[column].value)))
    };
    [entry(2, 1), entry(0, 2), entry(1, 0)]
}

fn by_rates<S: Scalar>(arm: &Arm<S>, at: &At<S>, j: usize) -> [Vector<S>; 2] {
    let (arm, at) = moving(arm, at, &unit(at.len(), j));
    let hand = hand_of(&arm, &poses(&arm, &at));
    let linear = hand.origin.each_ref().map(|x| x.rate.clone());
    [linear, angular(&hand)]
}

pub(super) fn by_lever<S: Scalar>(arm: &Arm<S>, levers: &[Columns<S>], j: usize) -> [Vector<S>; 2] {
    let frame = match arm.convention {
        Convention::Standard => &levers[j],
        Convention::Modified => &levers[j + 1],
    };
    let axis = frame.axes[2].clone();
    match arm.links[j].kind {
        JointKind::Prismatic => [axis, zero_vector()],
        JointKind::Revolute => [cross(&axis, &frame.origin), axis],
    }
}

/// Returns a velocity of the hand in base axes, in other axes; `hand` is its pose.
fn in_axes<S: Scalar>(
    axes: Axes,
    hand: Option<&Columns<S>>,
    [linear, angular]: [Vector<S>; 2],
) -> [Vector<S>; 2] {
    match (axes, hand) {
        (Axes::Mixed, _) | (_, None) => [linear, angular],
        (Axes::Local, Some(hand)) => [hand.rotate_back(&linear), hand.rotate_back(&angular)],
        // The linear velocity is that of the body's point at the base's origin.
        (Axes::World, Some(hand)) => [sum(&linear, &cross(&hand.origin, &angular)), angular],
    }
}

/// The third row of the hand's axes in a joint's frame is the joint's axis in the hand's.
fn local_columns<S: Scalar>(arm: &Arm<S>, at: &At<S>) -> Vec<[Vector<S>; 2]> {
    let mut pose = arm.in_last_frame();
    from_hand(arm.steps(at), |step| {
        let inner = inward(&step, &pose);
        let joint = step.at_joint(&inner, &pose);
        let axis = joint.axes.each_ref().map(|axis| axis[2].clone());
        let [x, y, _] = &joint.origin;
        let column = match step.link.kind {
            JointKind::Prismatic => [axis, zero_vector()],
            JointKind::Revolute => {
                let along = |axis: &Vector<S>| minus(&times(x, &axis[1]), &times(y, &axis[0]));
                [joint.axes.each_ref().map(along), axis]
            }
        };
        pose = inner;
        column
    })
}

fn inward<S: Scalar>(step: &Step<S>, pose: &Columns<S>) -> Columns<S> {
    let lever = step.lever();
    let axes = pose.axes.each_ref().map(|axis| step.to_previous(axis));
    let origin = sum(&step.to_previous(&pose.origin), &lever);
    Columns { axes, origin }
}

/// Returns the axes of frames 0 … n and, in the place of the origin, the lever from there to
/// the hand, in base axes. Added up from the hand on, no lever is a difference.
pub(super) fn levers<S: Scalar>(arm: &Arm<S>, at: &At<S>) -> Vec<Columns<S>> {
    let mut frames = joint_axes::frames(arm, at);
    let mut lever = match (frames.last(), &arm.tool) {
        (Some(last), Some(tool)) => last.rotate(&tool.origin),
        _ => zero_vector(),
    };
    for frame in frames.iter_mut().rev() {
        let step = core::mem::replace(&mut frame.origin, lever.clone());
        lever = sum(&step, &lever);
    }
    frames
}

fn hand_inward<S: Scalar>(arm: &Arm<S>, at: &At<S>) -> Columns<S> {
    let mut pose = arm.in_last_frame();
    for step in arm.steps(at).rev() {
        pose = inward(&step, &pose);
    }
    match &arm.base {
        None => pose,
        Some(base) => base.then(&pose),
    }
}

/// Two axes travel, x and z; y is z × x.
fn hand_by_two_axes<S: Scalar>(arm: &Arm<S>, at: &At<S>) -> Columns<S> {
    let hand = arm.in_last_frame();
    let ([mut x, _, mut z], mut origin) = (hand.axes, hand.origin);
    for step in arm.steps(at).rev() {
        let lever = step.lever();
        [x, z] = [&x, &z].map(|axis| step.to_previous(axis));
        origin = sum(&step.to_previous(&origin), &lever);
    }
    if let Some(base) = &arm.base {
        (x, z) = (base.rotate(&x), base.rotate(&z));
        origin = base.apply(&origin, &S::one());
    }
    with_axes(x, z, origin)
}

fn with_axes<S: Scalar>(x: Vector<S>, z: Vector<S>, origin: Vector<S>) -> Columns<S> {
    Columns {
        axes: [x.clone(), cross(&z, &x), z],
        origin,
    }
}

/// Returns the pose of the hand by the levers to it. Its z is that of the last frame, and
/// x is seen from the frame two joints before: the one between need not have all of its axes.
fn hand_by_levers<S: Scalar>(arm: &Arm<S>, at: &At<S>) -> Columns<S> {
    let levers = levers(arm, at);
    let mut hand = hand_of(arm, &levers);
    let outer = at.len().saturating_sub(2);
    if let Some(frame) = levers.get(outer) {
        let [mut x, ..] = arm.in_last_frame().axes;
        for step in arm.steps(at).skip(outer).rev() {
            x = step.to_previous(&x);
        }
        let [_, _, z] = hand.axes;
        hand = with_axes(frame.rotate(&x), z, hand.origin);
    }
    at_lever(arm, hand, levers[0].origin.clone())
}

/// From Ä J Aᵀ, whose last column is the force: ∫ (r̈ − g) dm and ∫ r × (r̈ − g) dm of link i.
fn inertial<S: Scalar>(
    arm: &Arm<S>,
    i: usize,
    pose: &Columns<S>,
    moving: &Columns<Twice<S>>,
) -> Wrench<S> {
    let body = PseudoInertia::of(&arm.links[i]);
    let accelerations = body.after(&moving.map(|x| x.rate.rate.clone()));
    let mass = &arm.links[i].mass;
    let first = scaled(mass, &pose.apply(&arm.links[i].com, &S::one()));
    let force = difference(&accelerations.origin, &scaled(mass, &arm.gravity));
    let product = |a: usize, b: usize| {
        let axes = accelerations.axes.iter().zip(&pose.axes);
        let turned = total(axes.map(|(x, y)| times(&x[a], &y[b])));
        plus(&turned, &times(&accelerations.origin[a], &pose.origin[b]))
    };
    let moment = [(2, 1), (0, 2), (1, 0)].map(|(a, b)| minus(&product(a, b), &product(b, a)));
    let weight = opposite(&cross(&first, &arm.gravity));
    let moment = sum(&moment, &weight);
    Wrench { force, moment }
}
