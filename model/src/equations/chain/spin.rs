//! Forward dynamics of a chain whose last link is symmetric about its axis.
//!
//! Such a link looks the same however far it has turned, so its joint has a
//! coordinate that nothing depends on. With J its inertia about the axis, A the
//! rotor's, ω_z its rate and s the part of the joint's angular acceleration that
//! the joints before bring along, its equation and the moment M on the link along
//! the axis are
//!
//! ```text
//! (J + A) q̈_n + J s = τ_n        M = J (q̈_n + s) = J/(J + A) τ_n + J A/(J + A) s
//! ```
//!
//! So the joints before feel a body that has A J/(J + A) about the axis and is fixed
//! to link n−1, and a couple that does not depend on q̈: what is left of τ_n along the
//! axis, and the gyroscopic moment across it. This is the first step of eliminating
//! joints from the hand inward, taken in the parameters: no entry of D is formed
//! with J and cleared of it again.

use alloc::vec::Vec;

use super::composite::{Composite, CompositeOrder};
use super::{Chain, Displacement, Form};
use crate::equations::forward::{inverted, solved};
use crate::equations::matrix::{
    dot, halved, minus, negative, over, plus, symmetric, times, total, zeros,
};
use crate::scalar::Divide;

/// A chain without its last joint, whose link is symmetric about the axis.
#[derive(Clone, Debug)]
pub struct Unspun<'a, S> {
    whole: &'a Composite<'a, S>,
    /// The joints before, and what of the last link no turn of its own changes.
    chain: Chain<S>,
    /// J
    inertia: S,
    /// 1/(J + A)
    inverse: S,
    /// J/(J + A)
    share: S,
    /// A J/(J + A)
    rest: S,
}

impl<'a, S: Divide> Unspun<'a, S> {
    /// Of a chain at its position, if its last joint moves, is not the only one
    /// and carries a link that is symmetric about it. J + A is the last joint's
    /// entry of D, a constant that is above zero where D has an inverse.
    pub fn new(whole: &'a Composite<'a, S>, moves: &[bool]) -> Option<Self> {
        let (link, inner) = whole.chain.links.split_last()?;
        if inner.is_empty() || !link.spins_freely || moves.last() != Some(&true) {
            return None;
        }
        let second = &link.body.second;
        let inertia = plus(&second.xx, &second.yy);
        let inverse = over(&S::one(), &plus(&inertia, &link.armature));
        // Without a rotor nothing is left, and no rounding of J/J either.
        let [share, rest] = match link.armature.is_zero() {
            true => [S::one(), S::zero()],
            false => {
                let share = times(&inertia, &inverse);
                let rest = times(&share, &link.armature);
                [share, rest]
            }
        };
        let mut body = link.body.clone();
        let across = plus(&second.yy, &second.zz);
        let half = halved(&rest);
        body.second.zz = minus(&across, &half);
        (body.second.xx, body.second.yy) = (half.clone(), half);
        let mut chain = whole.chain.clone();
        chain.links.pop();
        if let Some(last) = chain.links.last_mut() {
            let lever = link.lever(whole.at.last()?);
            last.body = last.body.with(&body.carried(&link.rotation, &lever));
        }
        Some(Unspun {
            whole,
            chain,
            inertia,
            inverse,
            share,
            rest,
        })
    }

    /// The joints before the last.
    fn at(&self) -> &[Displacement<S>] {
        &self.whole.at[..self.chain.links.len()]
    }

    /// What a unit acceleration of each joint before adds to the last one's.
    fn brought(&self) -> Vec<S> {
        let last = self.chain.links.len();
        let along = |i: usize| self.whole.twist(i, last).turn[2].clone();
        (0..last).map(along).collect()
    }

    /// q̈ under τ, zero of joints that do not move.
    pub fn forward_dynamics(&self, [qd, tau]: [&[S]; 2], moves: &[bool], form: Form) -> Vec<S> {
        let (chain, at, last) = (&self.chain, self.at(), self.chain.links.len());
        let (link, turn) = (&self.whole.chain.links[last], &self.whole.at[last]);
        let left = minus(&tau[last], &link.friction.torque(&qd[last]));
        let before = &qd[..last];
        let motions = chain.motions(at, before, &zeros(last), form.spin);
        let motion = &motions[last - 1];
        let [x, y, z] = link.inward(turn, &motion.omega);
        // J ω_z of the link, less what is left of it without a turn of its own.
        let momentum = minus(
            &times(&self.inertia, &plus(&z, &qd[last])),
            &times(&self.rest, &z),
        );
        let couple = [
            times(&momentum, &y),
            negative(&times(&momentum, &x)),
            times(&self.share, &left),
        ];
        let couple = link.outward(turn, &couple);
        let composite = Composite::new(chain, at);
        let drive = |i: usize| chain.links[i].friction.torque(&qd[i]);
        let bias = match form.composite_h {
            false => chain.torques(at, &motions, form.couple, &couple, drive),
            true => {
                let rest = zeros(last);
                let torques = composite.torques(&chain.gravity, before, &rest, form.spin, &couple);
                let torques = torques.iter().enumerate();
                torques.map(|(i, torque)| plus(torque, &drive(i))).collect()
            }
        };
        let d = composite.inertia(form.travel);
        let mut qdd = solved(&d, &bias, &tau[..last], &moves[..last]);
        let products = self.brought();
        let products = products.iter().zip(&qdd).map(|(x, qdd)| times(x, qdd));
        let still = dot(&link.axis_before(), &motion.omega_dot);
        let brought = plus(&still, &total(products));
        qdd.push(minus(
            &times(&left, &self.inverse),
            &times(&self.share, &brought),
        ));
        qdd
    }

    /// D⁻¹; zero in the rows and columns of joints that do not move.
    pub fn inertia_inverse(&self, moves: &[bool], travel: CompositeOrder) -> Vec<Vec<S>> {
        let last = self.chain.links.len();
        let d = Composite::new(&self.chain, self.at()).inertia(travel);
        let inner = inverted(&d, &moves[..last]);
        let brought = self.brought();
        let along = |row: &[S]| total(row.iter().zip(&brought).map(|(x, y)| times(x, y)));
        // The accelerations of the joints before under a unit torque of the last one.
        let given: Vec<S> = inner
            .iter()
            .map(|row| negative(&times(&self.share, &along(row))))
            .collect();
        let own = minus(&self.inverse, &times(&self.share, &along(&given)));
        symmetric(last + 1, |i, k| match (i == last, k == last) {
            (true, true) => own.clone(),
            (true, false) => given[k].clone(),
            (false, true) => given[i].clone(),
            (false, false) => inner[i][k].clone(),
        })
    }
}
