//! Second derivatives of λᵀτ from composite bodies: every entry is the power of a wrench of
//! the later joint on a twist of the earlier.

use alloc::vec::Vec;

use super::Body;
use super::composite::{Composite, CompositeOrder};
use super::derivatives::{Flow, Joint, inertial, rate};
use crate::equations::matrix::{Vector, cross, difference, dot, plus, sum, times, twice};
use crate::equations::matrix::{opposite, zero_vector};
use crate::equations::screws::{Twist, Wrench};
use crate::scalar::Scalar;

/// Second derivatives of a number, n×n each.
#[derive(Clone, Debug)]
pub struct SecondDerivatives<S> {
    /// By q and q, symmetric.
    pub position: Vec<Vec<S>>,
    /// By q, a row each, and q̇.
    pub mixed: Vec<Vec<S>>,
    /// By q̇ and q̇, symmetric.
    pub velocity: Vec<Vec<S>>,
    /// By q̈, or τ, a row each, and q.
    pub driven: Vec<Vec<S>>,
}

/// The twists of a joint that wrenches of later joints have power on.
struct Earlier<S> {
    /// Δ
    own: Twist<S>,
    /// Δ′
    virtually: Twist<S>,
    /// Δ̇
    first: Twist<S>,
    /// Δ̈
    second: Twist<S>,
}

/// What turning and driving a joint changes of its composite body.
struct Later<S> {
    /// Of the force ∫ a dm.
    force: Wrench<S>,
    /// Of the momentum ∫ ℓ dm of Λ.
    momentum: Wrench<S>,
    /// Of the force as its velocity grows.
    damping: Wrench<S>,
    /// The same as its acceleration grows.
    push: Wrench<S>,
    /// Of 2 ∫ v × ℓ dm.
    couple: Vector<S>,
    /// Of the same as its velocity grows.
    swing: Vector<S>,
}

impl<S: Scalar> Composite<'_, S> {
    /// Returns the second derivatives of λᵀτ; `driven` is ∂(D λ)/∂q, row i that of entry i.
    pub fn second_derivatives(
        &self,
        [qd, qdd, multiplier]: [&[S]; 3],
        travel: CompositeOrder,
    ) -> SecondDerivatives<S> {
        let (earlier, later) = self.pairs([qd, qdd, multiplier]);
        let n = earlier.len();
        let blank = || alloc::vec![alloc::vec![S::zero(); n]; n];
        let mut all = SecondDerivatives {
            position: blank(),
            mixed: blank(),
            velocity: blank(),
            driven: blank(),
        };
        for (k, own) in later.into_iter().enumerate() {
            all.enter(k, k, &earlier[k], &own);
            match travel {
                CompositeOrder::Inward => {
                    let mut wrenches = own;
                    for i in (0..k).rev() {
                        wrenches = self.carried_inward(i + 1, &wrenches);
                        all.enter(i, k, &earlier[i], &wrenches);
                    }
                }
                CompositeOrder::Outward => {
                    for (i, twists) in earlier.iter().enumerate().take(k) {
                        all.enter(i, k, &self.carried_outward(twists, i, k), &own);
                    }
                }
            }
        }
        let matrices = [&mut all.position, &mut all.mixed, &mut all.velocity];
        for matrix in matrices.into_iter().chain([&mut all.driven]) {
            self.matrix_in_metres(matrix);
        }
        for (i, link) in self.chain.links.iter().enumerate() {
            let bent = times(&multiplier[i], &link.friction.curvature(&qd[i]));
            all.velocity[i][i] = plus(&all.velocity[i][i], &bent);
        }
        all
    }

    /// Returns what each joint contributes by itself.
    fn pairs(&self, [qd, qdd, multiplier]: [&[S]; 3]) -> (Vec<Earlier<S>>, Vec<Later<S>>) {
        let chain = self.chain;
        let joints = self.own_slopes(qd, qdd);
        let velocities = chain.velocities(self.at, qd);
        let displacements = chain.velocities(self.at, multiplier);
        let (mut flow, mut couple) = (Flow::nothing(), zero_vector());
        let mut pairs = Vec::with_capacity(joints.len());
        for (i, (link, joint)) in chain.links.iter().zip(&joints).enumerate().rev() {
            let displacement = &displacements[i];
            flow = flow.with(&Flow::of(&link.body, displacement));
            let own = crossed(&link.body, &velocities[i], displacement);
            couple = sum(&couple, &own);
            let twists = Earlier {
                own: self.twist(i, i),
                virtually: rate(link, displacement),
                first: joint.drift[0].clone(),
                second: joint.drift[1].clone(),
            };
            let swing = opposite(&flow.swing(link));
            let wrenches = later(&self.bodies[i], joint, &twists, &flow, &couple, swing);
            pairs.push((twists, wrenches));
            flow = flow.carried(link, &self.at[i]);
            couple = link.outward(&self.at[i], &couple);
        }
        pairs.into_iter().rev().unzip()
    }

    fn carried_inward(&self, m: usize, own: &Later<S>) -> Later<S> {
        let wrench = |wrench| self.chain.to_previous(m, self.at, wrench);
        let turned = |vector| self.chain.links[m].outward(&self.at[m], vector);
        Later {
            force: wrench(&own.force),
            momentum: wrench(&own.momentum),
            damping: wrench(&own.damping),
            push: wrench(&own.push),
            couple: turned(&own.couple),
            swing: turned(&own.swing),
        }
    }

    fn carried_outward(&self, own: &Earlier<S>, from: usize, to: usize) -> Earlier<S> {
        let out = |twist| self.twist_outward(twist, from, to);
        Earlier {
            own: self.twist(from, to),
            virtually: out(&own.virtually),
            first: out(&own.first),
            second: out(&own.second),
        }
    }
}

impl<S: Scalar> SecondDerivatives<S> {
    /// Enters what joints i ≤ k have together, seen from one frame.
    fn enter(&mut self, i: usize, k: usize, earlier: &Earlier<S>, later: &Later<S>) {
        let Earlier {
            own,
            virtually,
            first,
            second,
        } = earlier;
        let powers = plus(&later.force.along(virtually), &later.momentum.along(second));
        let position = plus(&powers, &dot(&later.couple, &first.turn));
        self.position[i][k] = position.clone();
        self.position[k][i] = position;
        let velocity = dot(&later.swing, &own.turn);
        self.velocity[i][k] = velocity.clone();
        self.velocity[k][i] = velocity;
        self.mixed[i][k] = plus(
            &later.damping.along(virtually),
            &dot(&later.swing, &first.turn),
        );
        self.driven[k][i] = later.push.along(virtually);
        // Of a joint by itself both ways give the same.
        self.mixed[k][i] = plus(
            &twice(&later.momentum.along(first)),
            &dot(&later.couple, &own.turn),
        );
        self.driven[i][k] = later.momentum.along(own);
    }
}

/// Returns what follows from the flow of Λ and ∫ v × ℓ dm of the composite body.
fn later<S: Scalar>(
    body: &Body<S>,
    joint: &Joint<S>,
    twists: &Earlier<S>,
    flow: &Flow<S>,
    couple: &Vector<S>,
    swing: Vector<S>,
) -> Later<S> {
    let turned = flow.wrench().turned(&twists.own);
    let within = difference(
        &joint.flow.across(&twists.virtually),
        &flow.across(&twists.first),
    );
    let changed = sum(&cross(&twists.own.turn, couple), &within);
    Later {
        force: joint.position.1.clone(),
        momentum: turned.with(&inertial(body, &twists.virtually)),
        damping: joint.velocity.1.clone(),
        push: joint.push.clone(),
        couple: changed.each_ref().map(twice),
        swing,
    }
}

/// Returns ∫ v × ℓ dm of a body, where points move by v = v₀ + ω × r and by ℓ = ℓ₀ + ν × r:
/// (m v₀ + ω × s) × ℓ₀ + v₀ × (ν × s) + Σ (ω × ν), since (ω × r) × (ν × r) = r (r·(ω × ν)).
fn crossed<S: Scalar>(body: &Body<S>, v: &Twist<S>, l: &Twist<S>) -> Vector<S> {
    let momentum = Flow::of(body, v).wrench().force;
    let straight = sum(
        &cross(&momentum, &l.shift),
        &cross(&v.shift, &cross(&l.turn, &body.first)),
    );
    sum(&straight, &body.second_times(&cross(&v.turn, &l.turn)))
}
