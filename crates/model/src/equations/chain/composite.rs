//! D, h, h_ikm and c from composite bodies: the composite body m is everything from link m to
//! the hand, rigid, about the origin of frame m.

use alloc::vec::Vec;
use core::cmp::Ordering;

use super::recursion::{AccelerationForm, LinkMotion, MomentForm};
use super::{Chain, Displacement, MomentBody, Posture};
use crate::equations::matrix::*;
use crate::equations::screws::{Twist, Wrench};
use crate::robot::JointKind;
use crate::scalar::Scalar;

/// The direction in which the products for D travel; the values are equal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CompositeOrder {
    /// Joint twists go out to the composite bodies.
    Outward,
    /// Composite momenta come in to the joints.
    Inward,
}

/// Composite bodies and joint twists at one position.
#[derive(Clone, Debug)]
pub struct Composite<'a, S> {
    pub(super) chain: &'a Chain<S>,
    pub(super) at: &'a Posture<S>,
    /// That of a base that floats with all that it carries.
    pub(super) base: Option<MomentBody<S>>,
    pub(super) bodies: Vec<MomentBody<S>>,
    /// `twists[m][i]`, i < m: joint i seen from frame m.
    twists: Vec<Vec<Twist<S>>>,
}

/// The effect of turning and driving a joint on its composite, about a frame's origin in its axes.
#[derive(Clone)]
pub(super) struct JointEffect<S, const WRENCHES: usize, const VECTORS: usize> {
    pub(super) wrenches: [Wrench<S>; WRENCHES],
    pub(super) vectors: [Vector<S>; VECTORS],
}

impl<S: Scalar, const WRENCHES: usize, const VECTORS: usize> JointEffect<S, WRENCHES, VECTORS> {
    /// Carries it from frame i to the frame before.
    pub(super) fn carried(self, composite: &Composite<'_, S>, i: usize) -> Self {
        let (chain, at) = (composite.chain, composite.at);
        let wrenches = (self.wrenches).map(|wrench| chain.to_previous(i, at, &wrench));
        let vectors = (self.vectors).map(|vector| chain.links[i].outward(&at[i], &vector));
        JointEffect { wrenches, vectors }
    }
}

impl<'a, S: Scalar> Composite<'a, S> {
    /// Composes the bodies from the hand inward.
    pub fn new(chain: &'a Chain<S>, at: &'a Posture<S>) -> Self {
        let whole = |i: usize, outer: Option<MomentBody<S>>| {
            let outer = outer.unwrap_or_else(MomentBody::zero);
            let body = chain.links[i].body.with(&outer);
            (body.clone(), body)
        };
        let back = |i: usize, body: MomentBody<S>| {
            let (link, at) = (&chain.links[i], &at[i]);
            if link.parent.is_none() && chain.base.is_none() {
                return MomentBody::zero();
            }
            let turned = match at {
                Displacement::Turn(theta) => body.turned_z(theta).turned(&link.rotation),
                Displacement::Slide(_) => body,
            };
            turned.moved(&link.lever(at))
        };
        let (bodies, arrived) = chain.inward(whole, back, MomentBody::with);
        let arrived = arrived.unwrap_or_else(MomentBody::zero);
        let base = chain.base.as_ref().map(|body| body.with(&arrived));
        let mut twists: Vec<Vec<Twist<S>>> = Vec::with_capacity(chain.links.len());
        for (m, link) in chain.links.iter().enumerate() {
            let in_link = |twist: &Twist<S>| link.twist_outward(&at[m], twist);
            let mut row: Vec<Twist<S>> = Vec::with_capacity(m);
            if let Some(parent) = link.parent {
                row.extend(twists[parent].iter().map(in_link));
                row.push(in_link(&chain.links[parent].twist()));
            }
            // On another branch.
            row.resize(m, Twist::rest());
            twists.push(row);
        }
        Composite {
            chain,
            at,
            base,
            bodies,
            twists,
        }
    }

    pub(super) fn momentum(&self, k: usize) -> Wrench<S> {
        let (link, body) = (&self.chain.links[k], &self.bodies[k]);
        let second = &body.second;
        match link.kind {
            JointKind::Revolute => {
                let force = z_across(&body.first);
                let [x, y] = [&second.xz, &second.yz].map(negative);
                let moment = [x, y, plus(&second.xx, &second.yy)];
                Wrench { force, moment }
            }
            JointKind::Prismatic => slid(body, &link.axis),
        }
    }

    /// Returns D of all coordinates, armature on the diagonal.
    pub fn inertia(&self, travel: CompositeOrder) -> Matrix<S> {
        let n = self.chain.links.len();
        let columns: Matrix<S> = (0..n).map(|k| self.inertia_column(k, travel)).collect();
        let joints = symmetric(n, |i, k| columns[i][k].clone());
        match &self.base {
            None => joints,
            Some(body) => self.bordered_inertia(body, joints),
        }
    }

    /// Returns D_0k … D_kk.
    fn inertia_column(&self, k: usize, travel: CompositeOrder) -> Vec<S> {
        let mut wrench = self.momentum(k);
        let mut column = zeros(k + 1);
        for i in self.chain.way(k) {
            let load = match travel {
                CompositeOrder::Inward => self.chain.load(i, &wrench),
                CompositeOrder::Outward => self.project(i, k, &wrench),
            };
            column[i] = self.chain.rescaled(k, load);
            if i == k {
                column[i] = plus(&column[i], &self.chain.links[i].armature);
            }
            if travel == CompositeOrder::Inward && self.chain.links[i].parent.is_some() {
                wrench = self.chain.to_previous(i, self.at, &wrench);
            }
        }
        column
    }

    /// Returns `h[i][k][m]` = h_ikm, n×n×n.
    pub fn christoffel(&self) -> Vec<Matrix<S>> {
        let n = self.chain.links.len();
        let rows = |m: usize| (0..=m).map(|k| self.christoffel_row(k, m)).collect();
        let outer: Vec<Matrix<S>> = (0..n).map(rows).collect();
        symmetric_each(n, |i, m, k| match m.cmp(&i) {
            Ordering::Greater => outer[m][k][i].clone(),
            // h_iki = 0: a joint does not feel its own Coriolis term.
            Ordering::Equal => S::zero(),
            // h_ikm = −h_mki: joint i feels what joint m does not.
            Ordering::Less => negative(&outer[i][k][m]),
        })
    }

    /// Returns h_ikm of all i < m.
    fn christoffel_row(&self, k: usize, m: usize) -> Vec<S> {
        let wrench = self.quadratic(m, &self.twist(k, m).turn);
        let entry = |i: usize| self.chain.rescaled(m, self.project(i, m, &wrench));
        (0..m).map(entry).collect()
    }

    /// Returns c, an entry a coordinate.
    pub fn gravity(&self, travel: CompositeOrder) -> Vec<S> {
        let chain = self.chain;
        if travel == CompositeOrder::Inward {
            let rest = zeros(chain.coordinates());
            let (spin, couple) = (AccelerationForm::Column, MomentForm::SecondMoments);
            return chain.inverse_dynamics(self.at, &rest, &rest, spin, couple);
        }
        let base = self.base.iter().flat_map(|body| chain.weight(body));
        let mut c: Vec<S> = base.collect();
        chain.outward(chain.gravity.clone(), |i, before| {
            let (link, body) = (&chain.links[i], &self.bodies[i]);
            let gravity = link.inward(&self.at[i], before);
            c.push(match link.kind {
                JointKind::Revolute => {
                    let [x, y, _] = &body.first;
                    minus(&times(y, &gravity[0]), &times(x, &gravity[1]))
                }
                JointKind::Prismatic => {
                    let pull = dot(&scaled(&body.mass, &link.axis), &gravity);
                    negative(&times(&pull, &chain.per_unit))
                }
            });
            gravity
        });
        c
    }

    /// Returns τ, an entry a coordinate, without armature and damping.
    pub fn torques(
        &self,
        gravity: &Vector<S>,
        qd: &[S],
        qdd: &[S],
        spin: AccelerationForm,
        exerted: &Vector<S>,
    ) -> Vec<S> {
        let chain = self.chain;
        let (rates, accelerations) = (chain.rates(qd), chain.rates(qdd));
        let base = chain.base_motion([qd, qdd], gravity);
        let (mut wrenches, mut still_loads) = (Vec::new(), Vec::new());
        chain.outward(base.clone(), |i, before: &LinkMotion<S>| {
            let (link, body) = (&chain.links[i], &self.bodies[i]);
            let still = before.next(link, &self.at[i], &S::zero(), &S::zero(), spin);
            let at_rest = still.wrench(body, MomentForm::SecondMoments);
            still_loads.push(chain.load(i, &at_rest));
            // Σ_k (2 − δ_km) Δ_k q̇_k for k ≤ m.
            let mut turn = still.omega.clone().map(|x| twice(&x));
            if link.kind == JointKind::Revolute {
                turn[2] = plus(&turn[2], &rates[i]);
            }
            let (drift, push) = (self.quadratic(i, &turn), self.momentum(i));
            let both = |drift: &Vector<S>, push: &Vector<S>| {
                sum(&scaled(&rates[i], drift), &scaled(&accelerations[i], push))
            };
            let force = both(&drift.force, &push.force);
            let moment = both(&drift.moment, &push.moment);
            wrenches.push(Wrench { force, moment });
            before.next(link, &self.at[i], &rates[i], &accelerations[i], spin)
        });
        let wrench = |i: usize| wrenches[i].clone();
        let loads = chain.loads(self.at, wrench, exerted, |i| still_loads[i].clone());
        chain.with_base(loads, |body| {
            let whole = self.base.as_ref().unwrap_or(body);
            base.wrench(whole, MomentForm::SecondMoments)
        })
    }

    /// Returns the wrench of Δ_k Δ_m on the composite body m, `turn` being the angular part of Δ_k.
    fn quadratic(&self, m: usize, turn: &Vector<S>) -> Wrench<S> {
        let (link, body) = (&self.chain.links[m], &self.bodies[m]);
        match link.kind {
            // A point r moves by z × r; turning that gives turn × (z × r).
            JointKind::Revolute => {
                let [x, y, _] = body.second_times(turn);
                let force = cross(turn, &z_across(&body.first));
                let moment = [y, negative(&x), S::zero()];
                Wrench { force, moment }
            }
            JointKind::Prismatic => slid(body, &cross(turn, &link.axis)),
        }
    }

    /// Returns the turn and the shift of the origin of frame m, in its axes, by a unit of joint i ≤ m.
    pub fn motion(&self, i: usize, m: usize) -> [Vector<S>; 2] {
        let Twist { turn, shift } = self.twist(i, m);
        [turn, shift]
    }

    /// Returns the unit twist of joint i seen from frame m ≥ i.
    pub(super) fn twist(&self, i: usize, m: usize) -> Twist<S> {
        match i == m {
            true => self.chain.links[m].twist(),
            false => self.twists[m][i].clone(),
        }
    }

    pub(super) fn project(&self, i: usize, m: usize, wrench: &Wrench<S>) -> S {
        self.chain.rescaled(i, wrench.along(&self.twist(i, m)))
    }

    pub(super) fn matrix_in_metres(&self, matrix: &mut [Vec<S>]) {
        let chain = self.chain;
        for (i, row) in matrix.iter_mut().enumerate() {
            for (j, entry) in row.iter_mut().enumerate() {
                *entry = chain.rescaled(i, chain.rescaled(j, entry.clone()));
            }
        }
    }

    /// Enters every pair of joints i ≤ k, by twists of i, the first of which is its own, and what
    /// k does, both seen from one frame: what k does comes in to i, or twists of i go out to k.
    pub(super) fn each_pair<const TWISTS: usize, const WRENCHES: usize, const VECTORS: usize>(
        &self,
        travel: CompositeOrder,
        earlier: &[[Twist<S>; TWISTS]],
        later: Vec<JointEffect<S, WRENCHES, VECTORS>>,
        mut enter: impl FnMut([usize; 2], &[Twist<S>; TWISTS], &JointEffect<S, WRENCHES, VECTORS>),
    ) {
        let chain = self.chain;
        for (k, mut effect) in later.into_iter().enumerate() {
            enter([k, k], &earlier[k], &effect);
            match travel {
                CompositeOrder::Inward => {
                    for next in chain.way(k) {
                        let Some(i) = chain.links[next].parent else {
                            continue;
                        };
                        effect = effect.carried(self, next);
                        enter([i, k], &earlier[i], &effect);
                    }
                }
                CompositeOrder::Outward => {
                    let way: Vec<usize> = chain.way(k).skip(1).collect();
                    for (i, twists) in way.into_iter().rev().map(|i| (i, &earlier[i])) {
                        let outer_twists = core::array::from_fn(|place| match place {
                            0 => self.twist(i, k),
                            _ => self.twist_outward(&twists[place], i, k),
                        });
                        enter([i, k], &outer_twists, &effect);
                    }
                }
            }
        }
    }

    pub(super) fn twist_outward(&self, twist: &Twist<S>, j: usize, i: usize) -> Twist<S> {
        let out =
            |twist: Twist<S>, m: usize| self.chain.links[m].twist_outward(&self.at[m], &twist);
        let mut way: Vec<usize> = self.chain.way(i).take_while(|m| *m != j).collect();
        way.reverse();
        way.into_iter().fold(twist.clone(), out)
    }
}

fn slid<S: Scalar>(body: &MomentBody<S>, acceleration: &Vector<S>) -> Wrench<S> {
    let force = scaled(&body.mass, acceleration);
    let moment = cross(&body.first, acceleration);
    Wrench { force, moment }
}
