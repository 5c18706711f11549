//! Where things are, how they move with the joints, and what the joints carry.
//!
//! Lagrange–Euler takes rates of the poses themselves, by dual numbers; the
//! other formulations use axes and levers. Nothing is shared but eq. 2.1.

use alloc::vec::Vec;

use super::derivatives::with_rates;
use super::energy::moving;
use super::frames::Axes;
use super::lagrange_euler::PseudoInertia;
use super::matrix::{
    Columns, Vector, cross, difference, minus, negative, plus, scaled, sum, times, total, unit,
    zero_vector, zeros,
};
use super::newton_euler::{Motion, table1};
use super::screws::Wrench;
use super::{Arm, DhVariables, Formulation, Link, joint_axes};
use crate::robot::{Convention, JointKind};
use crate::scalar::Scalar;
use crate::scalar::dual::Dual;

/// Returns ⁰A_i of every frame i = 1 … n, in base axes.
pub fn poses<S: Scalar>(arm: &Arm<S>, at: &[DhVariables<S>]) -> Vec<Columns<S>> {
    poses_from(&arm.frame_0(), arm, at)
}

/// Returns the pose of every link's own frame, in base axes.
pub fn link_poses<S: Scalar>(arm: &Arm<S>, at: &[DhVariables<S>]) -> Vec<Columns<S>> {
    let poses = poses(arm, at).into_iter().enumerate();
    let poses = poses.map(|(link, pose)| match arm.frames.of_link(link) {
        None => pose,
        Some(own) => pose.then(own),
    });
    poses.collect()
}

fn poses_from<S: Scalar>(
    start: &Columns<S>,
    arm: &Arm<S>,
    at: &[DhVariables<S>],
) -> Vec<Columns<S>> {
    let mut poses: Vec<Columns<S>> = Vec::with_capacity(at.len());
    for (link, at) in arm.links.iter().zip(at) {
        let before = poses.last().unwrap_or(start);
        poses.push(link.append(arm.convention, at, before));
    }
    poses
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
    /// Returns the pose of the hand, ⁰A_n but for base and tool: the recursions in link
    /// axes go from the hand inward, which is less work alone, with three axes or with
    /// two; Lagrange–Euler multiplies from the base outward; the others add the levers
    /// of a Jacobian, in base axes or in the joints' own.
    pub fn hand<S: Scalar>(self, arm: &Arm<S>, at: &[DhVariables<S>]) -> Columns<S> {
        let (arm, at) = arm.to_hand(at);
        let arm = &*arm;
        match self {
            Self::LagrangeEuler => hand_of(arm, &poses(arm, at)),
            Self::Dalembert => hand_by_levers(arm, at, &levers(arm, at)),
            Self::NewtonEulerBase => joint_axes::hand(arm, at),
            Self::NewtonEulerLink | Self::NewtonEulerLinkDifferences => hand_inward(arm, at),
            Self::NewtonEulerLinkAsPrinted => hand_by_two_axes(arm, at),
        }
    }

    /// Returns J, 6×n: row by row the linear and the angular velocity of the hand for
    /// each unit rate, in the arm's [`Axes`].
    pub fn jacobian<S: Scalar>(self, arm: &Arm<S>, at: &[DhVariables<S>]) -> Vec<Vec<S>> {
        let n = at.len();
        let (arm, at) = arm.to_hand(at);
        let by_links = matches!(
            self,
            Self::NewtonEulerLink | Self::NewtonEulerLinkDifferences
        );
        let mut columns = match arm.frames.axes {
            Axes::Local if by_links => local_columns(&arm, at),
            axes => {
                let columns = self.mixed_columns(&arm, at);
                let hand = (axes != Axes::Mixed).then(|| self.hand(&arm, at));
                let own = columns.into_iter();
                own.map(|column| in_axes(axes, hand.as_ref(), column))
                    .collect()
            }
        };
        columns.resize(n, [zero_vector(), zero_vector()]);
        let row = |r: usize| columns.iter().map(move |c| c[r / 3][r % 3].clone());
        (0..6).map(|r| row(r).collect()).collect()
    }

    fn mixed_columns<S: Scalar>(self, arm: &Arm<S>, at: &[DhVariables<S>]) -> Vec<[Vector<S>; 2]> {
        match self {
            Self::LagrangeEuler => (0..at.len()).map(|j| by_rates(arm, at, j)).collect(),
            Self::NewtonEulerBase => joint_axes::columns(arm, at),
            Self::NewtonEulerLinkAsPrinted => joint_axes::columns_across(arm, at),
            _ => {
                let levers = levers(arm, at);
                (0..at.len()).map(|j| geometric(arm, &levers, j)).collect()
            }
        }
    }

    /// Returns J̇ q̇, linear over angular, in the arm's [`Axes`]: the rate of J q̇ in a motion that
    /// keeps its velocities. In base axes at the hand it is the hand's acceleration.
    pub fn jacobian_rate<S: Scalar>(
        self,
        arm: &Arm<S>,
        at: &[DhVariables<S>],
        qd: &[S],
    ) -> [Vector<S>; 2] {
        let (arm, at) = arm.to_hand(at);
        let qd = &qd[..at.len()];
        let rate = self.acceleration_without_qdd(&arm, at, qd);
        let axes = arm.frames.axes;
        if axes == Axes::Mixed {
            return rate;
        }
        // The frame's point moves on: v × ω, in base axes.
        let columns = self.mixed_columns(&arm, at);
        let columns = columns.iter().zip(qd);
        let mut twist = [zero_vector(), zero_vector()];
        for (column, qd) in columns {
            twist = [0, 1].map(|part| sum(&twist[part], &scaled(qd, &column[part])));
        }
        let [v, omega] = &twist;
        let [linear, angular] = rate;
        let linear = sum(&linear, &cross(v, omega));
        in_axes(axes, Some(&self.hand(&arm, at)), [linear, angular])
    }

    fn acceleration_without_qdd<S: Scalar>(
        self,
        arm: &Arm<S>,
        at: &[DhVariables<S>],
        qd: &[S],
    ) -> [Vector<S>; 2] {
        if self != Self::LagrangeEuler {
            let arm = arm.weightless();
            let base = Motion::of_base(&arm.gravity);
            let rate = table1::tip_acceleration(&arm, at, qd, &zeros(qd.len()), &base);
            return match &arm.base {
                None => rate,
                Some(base) => rate.each_ref().map(|part| base.rotate(part)),
            };
        }
        let rest: Vec<S> = zeros(qd.len());
        let (arm, at) = accelerated(arm, at, qd, &rest);
        let hand = hand_of(&arm, &poses(&arm, &at));
        let linear = hand.origin.each_ref().map(|x| x.rate.rate.clone());
        [linear, angular(&hand).map(|omega| omega.rate)]
    }

    /// Returns what link i−1 exerts on link i, gravity included, in base axes;
    /// the moment about the origin of frame i−1, or of frame i in modified DH.
    pub fn wrenches<S: Scalar>(
        self,
        arm: &Arm<S>,
        at: &[DhVariables<S>],
        qd: &[S],
        qdd: &[S],
    ) -> Vec<Wrench<S>> {
        let wrenches = match self {
            Self::LagrangeEuler => wrenches_by_poses(arm, at, qd, qdd),
            _ => table1::wrenches(arm, at, qd, qdd),
        };
        match &arm.base {
            None => wrenches,
            Some(base) => {
                let wrenches = wrenches.iter();
                wrenches
                    .map(|wrench| wrench.in_axes(|v| base.rotate(v)))
                    .collect()
            }
        }
    }
}

/// Returns the wrenches in the axes of frame 0, as gravity is.
fn wrenches_by_poses<S: Scalar>(
    arm: &Arm<S>,
    at: &[DhVariables<S>],
    qd: &[S],
    qdd: &[S],
) -> Vec<Wrench<S>> {
    let (arm_moving, at_moving) = accelerated(arm, at, qd, qdd);
    let moving = poses_from(&Columns::identity(), &arm_moving, &at_moving);
    let still = poses_from(&Columns::identity(), arm, at);
    let n = at.len();
    let mut wrenches = Vec::with_capacity(n);
    let mut about_base = Wrench::zero();
    for i in (0..n).rev() {
        about_base = about_base.with(&inertial(arm, i, &still[i], &moving[i]));
        let Wrench { force, moment } = &about_base;
        let point = match (arm.convention, i) {
            (Convention::Modified, _) => still[i].origin.clone(),
            (Convention::Standard, 0) => zero_vector(),
            (Convention::Standard, _) => still[i - 1].origin.clone(),
        };
        wrenches.push(Wrench {
            moment: difference(moment, &cross(&point, force)),
            force: force.clone(),
        });
    }
    wrenches.reverse();
    wrenches
}

type Twice<S> = Dual<Dual<S>>;

fn accelerated<S: Scalar>(
    arm: &Arm<S>,
    at: &[DhVariables<S>],
    qd: &[S],
    qdd: &[S],
) -> (Arm<Twice<S>>, Vec<DhVariables<Twice<S>>>) {
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

fn by_rates<S: Scalar>(arm: &Arm<S>, at: &[DhVariables<S>], j: usize) -> [Vector<S>; 2] {
    let (arm, at) = moving(arm, at, &unit(at.len(), j));
    let hand = hand_of(&arm, &poses(&arm, &at));
    let linear = hand.origin.each_ref().map(|x| x.rate.clone());
    [linear, angular(&hand)]
}

pub(super) fn geometric<S: Scalar>(
    arm: &Arm<S>,
    levers: &[Columns<S>],
    j: usize,
) -> [Vector<S>; 2] {
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
        // Of the point of the same body that is at the base's origin.
        (Axes::World, Some(hand)) => [sum(&linear, &cross(&hand.origin, &angular)), angular],
    }
}

/// The third row of the hand's axes in a joint's frame is the joint's axis in the hand's.
fn local_columns<S: Scalar>(arm: &Arm<S>, at: &[DhVariables<S>]) -> Vec<[Vector<S>; 2]> {
    let mut pose = arm.in_last_frame();
    let mut columns = Vec::with_capacity(at.len());
    for (link, at) in arm.links.iter().zip(at).rev() {
        let inner = inward(arm, link, at, &pose);
        let joint = match arm.convention {
            Convention::Standard => &inner,
            Convention::Modified => &pose,
        };
        let axis = joint.axes.each_ref().map(|axis| axis[2].clone());
        let [x, y, _] = &joint.origin;
        columns.push(match link.kind {
            JointKind::Prismatic => [axis, zero_vector()],
            JointKind::Revolute => {
                let along = |axis: &Vector<S>| minus(&times(x, &axis[1]), &times(y, &axis[0]));
                [joint.axes.each_ref().map(along), axis]
            }
        });
        pose = inner;
    }
    columns.reverse();
    columns
}

fn inward<S: Scalar>(
    arm: &Arm<S>,
    link: &Link<S>,
    at: &DhVariables<S>,
    pose: &Columns<S>,
) -> Columns<S> {
    let step = link.append(arm.convention, at, &Columns::identity());
    let turn = |v: &Vector<S>| link.to_previous(arm.convention, at, v);
    Columns {
        axes: pose.axes.each_ref().map(turn),
        origin: sum(&turn(&pose.origin), &step.origin),
    }
}

/// Returns the axes of frames 0 … n and, in the place of the origin, the lever from there to
/// the hand, in base axes. Added up from the hand on, no lever is a difference.
pub(super) fn levers<S: Scalar>(arm: &Arm<S>, at: &[DhVariables<S>]) -> Vec<Columns<S>> {
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

fn hand_inward<S: Scalar>(arm: &Arm<S>, at: &[DhVariables<S>]) -> Columns<S> {
    let mut pose = arm.in_last_frame();
    for (link, at) in arm.links.iter().zip(at).rev() {
        pose = inward(arm, link, at, &pose);
    }
    match &arm.base {
        None => pose,
        Some(base) => base.then(&pose),
    }
}

/// Two axes travel, x and z; y is z × x.
fn hand_by_two_axes<S: Scalar>(arm: &Arm<S>, at: &[DhVariables<S>]) -> Columns<S> {
    let Columns {
        axes: [mut x, _, mut z],
        mut origin,
    } = arm.in_last_frame();
    for (link, at) in arm.links.iter().zip(at).rev() {
        let step = link.append(arm.convention, at, &Columns::identity());
        let turn = |v: &Vector<S>| link.to_previous(arm.convention, at, v);
        (x, z) = (turn(&x), turn(&z));
        origin = sum(&turn(&origin), &step.origin);
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

/// Returns the pose of the hand by the levers to it. Of its axes z is that of the last frame's, and
/// x is seen from the frame two joints before: the one between need not have all of its axes.
fn hand_by_levers<S: Scalar>(
    arm: &Arm<S>,
    at: &[DhVariables<S>],
    levers: &[Columns<S>],
) -> Columns<S> {
    let mut hand = hand_of(arm, levers);
    let outer = at.len().saturating_sub(2);
    if let Some(frame) = levers.get(outer) {
        let [mut x, ..] = arm.in_last_frame().axes;
        for (link, at) in arm.links.iter().zip(at).skip(outer).rev() {
            x = link.to_previous(arm.convention, at, &x);
        }
        let [_, _, z] = hand.axes;
        hand = with_axes(frame.rotate(&x), z, hand.origin);
    }
    let whole = levers
        .first()
        .map_or_else(zero_vector, |first| first.origin.clone());
    at_lever(arm, hand, whole)
}

/// From Ä J Aᵀ, whose last column is the force: ∫ (r̈ − g) dm and ∫ r × (r̈ − g) dm of link i.
fn inertial<S: Scalar>(
    arm: &Arm<S>,
    i: usize,
    pose: &Columns<S>,
    moving: &Columns<Dual<Dual<S>>>,
) -> Wrench<S> {
    let body = PseudoInertia::of(&arm.links[i]);
    let second = |v: &Vector<Dual<Dual<S>>>| v.each_ref().map(|x| x.rate.rate.clone());
    let accelerations = body.after(&Columns {
        axes: moving.axes.each_ref().map(second),
        origin: second(&moving.origin),
    });
    let mass = &arm.links[i].mass;
    let first = scaled(mass, &pose.apply(&arm.links[i].com, &S::one()));
    let force = difference(&accelerations.origin, &scaled(mass, &arm.gravity));
    let product = |a: usize, b: usize| {
        let axes = accelerations.axes.iter().zip(&pose.axes);
        let turned = total(axes.map(|(x, y)| times(&x[a], &y[b])));
        plus(&turned, &times(&accelerations.origin[a], &pose.origin[b]))
    };
    let moment = [(2, 1), (0, 2), (1, 0)].map(|(a, b)| minus(&product(a, b), &product(b, a)));
    let weight = cross(&first, &arm.gravity).map(|x| negative(&x));
    Wrench {
        moment: sum(&moment, &weight),
        force,
    }
}
