//! Second derivatives of λᵀτ from composite bodies: every entry is the power of a wrench of
//! the later joint on a twist of the earlier.

use alloc::vec::Vec;

use super::MomentBody;
use super::composite::{Composite, CompositeOrder, JointEffect};
use super::derivatives::{Flow, JointSlopes, inertial, rate};
use crate::equations::matrix::*;
use crate::equations::screws::Twist;
use crate::scalar::Scalar;

/// Second derivatives of a number, n×n each.
#[derive(Clone, Debug)]
pub struct SecondDerivatives<S> {
    /// By q and q, symmetric.
    pub position: Matrix<S>,
    /// By q, a row each, and q̇.
    pub mixed: Matrix<S>,
    /// By q̇ and q̇, symmetric.
    pub velocity: Matrix<S>,
    /// By q̈, or τ, a row each, and q.
    pub driven: Matrix<S>,
}

/// Δ, Δ′, Δ̇ and Δ̈ of a joint: the twists that wrenches of later joints have power on.
type Earlier<S> = [Twist<S>; 4];

/// The change of a joint's composite body as the joint turns and is driven: of the force ∫ a dm, of
/// the momentum ∫ ℓ dm of Λ, of the force as the joint's velocity grows and as its acceleration does;
/// of 2 ∫ v × ℓ dm, and of the same as its velocity grows.
type Later<S> = JointEffect<S, 4, 2>;

impl<S: Scalar> Composite<'_, S> {
    /// Returns the second derivatives of λᵀτ; `driven` is ∂(D λ)/∂q, row i that of entry i.
    pub fn second_derivatives(
        &self,
        [qd, qdd, multiplier]: [&[S]; 3],
        travel: CompositeOrder,
    ) -> SecondDerivatives<S> {
        let (earlier, later) = self.pairs([qd, qdd, multiplier]);
        let blank = || zero_matrix(earlier.len());
        let mut derivatives = SecondDerivatives {
            position: blank(),
            mixed: blank(),
            velocity: blank(),
            driven: blank(),
        };
        self.each_pair(travel, &earlier, later, |joints, earlier, later| {
            derivatives.enter(joints, earlier, later);
        });
        self.matrix_in_metres(&mut derivatives.position);
        self.matrix_in_metres(&mut derivatives.mixed);
        self.matrix_in_metres(&mut derivatives.velocity);
        self.matrix_in_metres(&mut derivatives.driven);
        for (i, link) in self.chain.links.iter().enumerate() {
            let bent = times(&multiplier[i], &link.friction.curvature(&qd[i]));
            derivatives.velocity[i][i] = plus(&derivatives.velocity[i][i], &bent);
        }
        derivatives
    }

    fn pairs(&self, [qd, qdd, multiplier]: [&[S]; 3]) -> (Vec<Earlier<S>>, Vec<Later<S>>) {
        let chain = self.chain;
        let (joints, _) = self.joint_slopes(qd, qdd);
        let velocities = chain.velocities(self.at, Twist::rest(), qd);
        let displacements = chain.velocities(self.at, Twist::rest(), multiplier);
        let whole = |i: usize, outer: Option<(Flow<S>, Vector<S>)>| {
            let (link, joint, displacement) = (&chain.links[i], &joints[i], &displacements[i]);
            let (flow, couple) = outer.unwrap_or_else(|| (Flow::nothing(), zero_vector()));
            let flow = flow.with(&Flow::of(&link.body, displacement));
            let of_link = crossed(&link.body, &velocities[i], displacement);
            let couple = sum(&couple, &of_link);
            let [first, second] = joint.drift.clone();
            let twists = [self.twist(i, i), rate(link, displacement), first, second];
            let swing = opposite(&flow.swing(link));
            let wrenches = later(&self.bodies[i], joint, &twists, &flow, &couple, swing);
            ((flow, couple), (twists, wrenches))
        };
        let back = |i: usize, (flow, couple): (Flow<S>, Vector<S>)| {
            let (link, at) = (&chain.links[i], &self.at[i]);
            (flow.carried(link, at), link.outward(at, &couple))
        };
        let (pairs, _) = chain.inward(whole, back, |(flow, couple), (other, more)| {
            (flow.with(other), sum(couple, more))
        });
        pairs.into_iter().unzip()
    }
}

impl<S: Scalar> SecondDerivatives<S> {
    fn enter(&mut self, [i, k]: [usize; 2], earlier: &Earlier<S>, later: &Later<S>) {
        let [twist, virtual_twist, first, second] = earlier;
        let [force, momentum, damping, push] = &later.wrenches;
        let [couple, swing] = &later.vectors;
        let powers = plus(&force.along(virtual_twist), &momentum.along(second));
        let position = plus(&powers, &dot(couple, &first.turn));
        self.position[i][k] = position.clone();
        self.position[k][i] = position;
        let velocity = dot(swing, &twist.turn);
        self.velocity[i][k] = velocity.clone();
        self.velocity[k][i] = velocity;
        self.mixed[i][k] = plus(&damping.along(virtual_twist), &dot(swing, &first.turn));
        self.driven[k][i] = push.along(virtual_twist);
        self.mixed[k][i] = plus(&twice(&momentum.along(first)), &dot(couple, &twist.turn));
        self.driven[i][k] = momentum.along(twist);
    }
}

fn later<S: Scalar>(
    body: &MomentBody<S>,
    joint: &JointSlopes<S>,
    [twist, virtual_twist, first, _]: &Earlier<S>,
    flow: &Flow<S>,
    couple: &Vector<S>,
    swing: Vector<S>,
) -> Later<S> {
    let turned = flow.wrench().turned(twist);
    let within = difference(&joint.flow.across(virtual_twist), &flow.across(first));
    let changed = sum(&cross(&twist.turn, couple), &within);
    JointEffect {
        wrenches: [
            joint.position.1.clone(),
            turned.with(&inertial(body, virtual_twist)),
            joint.velocity.1.clone(),
            joint.push.clone(),
        ],
        vectors: [changed.each_ref().map(twice), swing],
    }
}

/// Returns ∫ v × ℓ dm of a body, where points move by v = v₀ + ω × r and by ℓ = ℓ₀ + ν × r:
/// (m v₀ + ω × s) × ℓ₀ + v₀ × (ν × s) + Σ (ω × ν), since (ω × r) × (ν × r) = r (r·(ω × ν)).
fn crossed<S: Scalar>(body: &MomentBody<S>, v: &Twist<S>, l: &Twist<S>) -> Vector<S> {
    let momentum = Flow::of(body, v).wrench().force;
    let straight = cross(&momentum, &l.shift);
    let straight = sum(&straight, &cross(&v.shift, &cross(&l.turn, &body.first)));
    sum(&straight, &body.second_times(&cross(&v.turn, &l.turn)))
}
