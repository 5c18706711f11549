//! Both DH conventions as one kind of chain, with regrouped parameters.
//!
//! `README.md` beside this file derives each module's formulas from the textbook form, in
//! sections with the modules' names.

pub mod body;
mod centroidal;
pub mod composite;
pub mod derivatives;
pub mod floating;
mod form;
mod momentum;
mod parallel;
mod passivity;
pub mod pose;
pub mod recursion;
pub mod regressor;
pub mod regrouping;
pub mod second_derivatives;
mod shoulder;
pub mod skeleton;
mod spin;

use alloc::vec::Vec;

pub use body::MomentBody;
pub use form::{Form, HandChoice, HandForm};
pub use parallel::Unknowns;
pub use pose::{Displacement, Posture};
pub use regressor::{Column, Probe, Probed};
pub use regrouping::{LinkRegrouping, MetricChain, Regrouping};
pub use skeleton::{Segment, Skeleton};
pub use spin::EliminatedTip;

use super::SinCosPair;
use super::friction::Friction;
use super::matrix::*;
use super::screws::Twist;
use crate::robot::JointKind;
use crate::scalar::Scalar;

/// A constant rotation, row by row.
pub type Rotation<S> = [Vector<S>; 3];

/// A chain of links, or a tree. Frame i of a revolute joint turns about its own z axis;
/// that of a prismatic joint keeps the axes of the frame before it.
#[derive(Clone, Debug)]
pub struct Chain<S> {
    /// Acceleration of gravity in base axes.
    pub gravity: Vector<S>,
    /// The body of a base that floats, about the origin of the base.
    pub base: Option<MomentBody<S>>,
    /// The probes that are fixed to it.
    pub base_probes: Vec<Probe<S>>,
    /// Links, each after the one that carries it.
    pub links: Vec<ChainLink<S>>,
    /// 1 / the unit of length.
    pub per_unit: S,
    /// The number of columns of a regressor that the links' probes are.
    pub columns: usize,
}

/// One joint with what it moves.
#[derive(Clone, Debug)]
pub struct ChainLink<S> {
    /// The link that carries it; none of one that the base carries.
    pub parent: Option<usize>,
    /// Revolute or prismatic.
    pub kind: JointKind,
    /// Revolute: axes of frame i at θ = 0 in the axes of frame i−1. Prismatic: the identity.
    pub rotation: Rotation<S>,
    /// Origin of frame i (at q = 0 if prismatic) in frame i−1.
    pub offset: Vector<S>,
    /// Direction of the slide in the axes of frame i; z for a revolute joint.
    pub axis: Vector<S>,
    /// The pair of the constant added to q (revolute).
    pub theta: SinCosPair<S>,
    /// The link, about the origin and in the axes of its frame.
    pub body: MomentBody<S>,
    /// The probes that are fixed to it, a column of a regressor each; not regrouped.
    pub probes: Vec<Probe<S>>,
    /// Mass, first and second moment along a revolute axis that the link could keep, arrivals too.
    pub free: [S; 3],
    /// Rotor inertia felt at the joint.
    pub armature: S,
    /// The friction of the joint.
    pub friction: Friction<S>,
    /// True if the frame may stay behind: of a last link that is symmetric about its axis.
    pub spins_freely: bool,
    /// By how many joints the frame turns more than its link, where it can.
    pub axes: i32,
}

impl<S: Scalar> Chain<S> {
    /// Returns the chain of a skeleton in a regrouping.
    pub fn new(skeleton: &Skeleton<S>, regrouping: &Regrouping<S>) -> Chain<S> {
        MetricChain::new(skeleton, regrouping).in_unit(regrouping)
    }

    /// True if the base stands still and each link is carried by the one before.
    pub fn is_serial(&self) -> bool {
        let mut parents = self.links.iter().map(|link| link.parent).enumerate();
        self.base.is_none() && parents.all(|(i, parent)| parent == i.checked_sub(1))
    }

    /// Lists a link and those that carry it, to the base.
    pub fn way(&self, from: usize) -> impl Iterator<Item = usize> {
        core::iter::successors(Some(from), |&i| self.links[i].parent)
    }

    /// Walks from the base to the tips: returns what follows for each link from what its carrier has.
    fn outward<T>(&self, base: T, mut next: impl FnMut(usize, &T) -> T) -> Vec<T> {
        let mut results: Vec<T> = Vec::with_capacity(self.links.len());
        for (i, link) in self.links.iter().enumerate() {
            let before = link.parent.map_or(&base, |parent| &results[parent]);
            results.push(next(i, before));
        }
        results
    }

    /// Walks from the tips to the base. `whole` returns what a link has with all that it carries, from
    /// what arrives there, and its entry; `back` brings it to the link before, `with` adds what
    /// arrives there. Returns the entries in the order of the links, and what arrives at the base.
    fn inward<T, J>(
        &self,
        mut whole: impl FnMut(usize, Option<T>) -> (T, J),
        back: impl Fn(usize, T) -> T,
        with: impl Fn(&T, &T) -> T,
    ) -> (Vec<J>, Option<T>) {
        let n = self.links.len();
        let mut arrived: Vec<Option<T>> = (0..=n).map(|_| None).collect();
        let entries = from_hand(0..n, |i| {
            let (total, entry) = whole(i, arrived[i].take());
            let carried = back(i, total);
            let place = &mut arrived[self.links[i].parent.unwrap_or(n)];
            *place = Some(match place {
                Some(others) => with(others, &carried),
                None => carried,
            });
            entry
        });
        (entries, arrived.pop().flatten())
    }

    /// Leaves out the friction of all joints.
    #[must_use]
    pub fn without_friction(mut self) -> Chain<S> {
        for link in &mut self.links {
            link.friction = Friction::none();
        }
        self
    }

    /// Slides are scaled: a rate to the chain's unit of length, a load or a slope back from there.
    fn rescaled(&self, joint: usize, value: S) -> S {
        match self.links[joint].kind {
            JointKind::Revolute => value,
            JointKind::Prismatic => times(&value, &self.per_unit),
        }
    }

    /// Returns the rates of the joints in the chain's unit.
    fn rates(&self, rates: &[S]) -> Vec<S> {
        let joints = self.of_joints(rates).iter().take(self.links.len());
        let rates = joints.cloned().enumerate();
        rates.map(|(i, rate)| self.rescaled(i, rate)).collect()
    }
}

impl<S> Chain<S> {
    /// Returns every parameter through `f`.
    pub fn map<T>(&self, mut f: impl FnMut(&S) -> T) -> Chain<T> {
        // Compiled once for each scalar.
        let mut f: &mut dyn FnMut(&S) -> T = &mut f;
        let gravity = self.gravity.each_ref().map(&mut f);
        let base = self.base.as_ref().map(|body| body.map(&mut f));
        let links = self.links.iter().map(|link| ChainLink {
            parent: link.parent,
            kind: link.kind,
            rotation: three(|row| link.rotation[row].each_ref().map(&mut f)),
            offset: link.offset.each_ref().map(&mut f),
            axis: link.axis.each_ref().map(&mut f),
            theta: link.theta.map(&mut f),
            body: link.body.map(&mut f),
            probes: Probe::each(&link.probes, |body| body.map(&mut f)),
            free: link.free.each_ref().map(&mut f),
            armature: f(&link.armature),
            friction: link.friction.map(&mut f),
            spins_freely: link.spins_freely,
            axes: link.axes,
        });
        Chain {
            gravity,
            base,
            links: links.collect(),
            base_probes: Probe::each(&self.base_probes, |body| body.map(&mut f)),
            per_unit: f(&self.per_unit),
            columns: self.columns,
        }
    }
}

impl<S: Clone> Chain<S> {
    /// Returns the chain at velocities of these r_i, where joints have Coulomb friction.
    #[must_use]
    pub fn at_speeds(mut self, per_speed: &[Option<S>]) -> Chain<S> {
        for (link, per_speed) in self.links.iter_mut().zip(per_speed) {
            link.friction.take_speed(per_speed.as_ref());
        }
        self
    }
}

impl<S: Scalar> ChainLink<S> {
    /// Returns components in frame i, from those in frame i−1.
    pub fn inward(&self, at: &Displacement<S>, v: &Vector<S>) -> Vector<S> {
        match at {
            Displacement::Turn(theta) => {
                theta.turn_back_in(ABOUT_Z, apply_transposed(&self.rotation, v))
            }
            Displacement::Slide(_) => v.clone(),
        }
    }

    /// Components from frame i into frame i−1.
    fn outward(&self, at: &Displacement<S>, v: &Vector<S>) -> Vector<S> {
        match at {
            Displacement::Turn(theta) => apply(&self.rotation, &theta.turn_in(ABOUT_Z, v.clone())),
            Displacement::Slide(_) => v.clone(),
        }
    }

    fn twist(&self) -> Twist<S> {
        Twist::of_joint(self.kind, self.axis.clone())
    }

    /// Returns a twist of frame i−1 as seen from frame i.
    fn twist_outward(&self, at: &Displacement<S>, twist: &Twist<S>) -> Twist<S> {
        let lever = self.lever(at);
        let turn = self.inward(at, &twist.turn);
        let shift = self.inward(at, &sum(&twist.shift, &cross(&twist.turn, &lever)));
        Twist { turn, shift }
    }

    fn axis_before(&self) -> Vector<S> {
        apply(&self.rotation, &self.axis)
    }

    /// Returns the origin of frame i in frame i−1.
    fn lever(&self, at: &Displacement<S>) -> Vector<S> {
        match at {
            Displacement::Turn(_) => self.offset.clone(),
            Displacement::Slide(q) => sum(&self.offset, &scaled(q, &self.axis)),
        }
    }
}

fn turn<S: Scalar>(angle: &SinCosPair<S>, [i, j]: [usize; 2]) -> Rotation<S> {
    let mut turned = identity();
    [turned[i][i], turned[j][j]] = [angle.cos.clone(), angle.cos.clone()];
    [turned[i][j], turned[j][i]] = [angle.sin.neg(), angle.sin.clone()];
    turned
}

fn product<S: Scalar>(a: &Rotation<S>, b: &Rotation<S>) -> Rotation<S> {
    let columns = transposed(b);
    three(|i| three(|k| dot(&a[i], &columns[k])))
}

fn apply<S: Scalar>(rotation: &Rotation<S>, v: &Vector<S>) -> Vector<S> {
    rotation.each_ref().map(|row| dot(row, v))
}

fn apply_transposed<S: Scalar>(rotation: &Rotation<S>, v: &Vector<S>) -> Vector<S> {
    apply(&transposed(rotation), v)
}
