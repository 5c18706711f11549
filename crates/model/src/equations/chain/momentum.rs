//! Energies and momenta of a chain: what a link's motion is, not what changes it.

use alloc::vec::Vec;

use super::{Chain, ChainLink, Displacement};
use crate::equations::matrix::*;
use crate::equations::screws::{Twist, Wrench};
use crate::robot::JointKind;
use crate::scalar::Scalar;

impl<S: Scalar> Twist<S> {
    fn next(&self, link: &ChainLink<S>, at: &Displacement<S>, rate: &S) -> Self {
        let carried = sum(&self.shift, &cross(&self.turn, &link.lever(at)));
        let own = scaled(rate, &link.axis);
        let (turn, shift) = (link.inward(at, &self.turn), link.inward(at, &carried));
        let (turn, shift) = match link.kind {
            JointKind::Revolute => (sum(&turn, &own), shift),
            JointKind::Prismatic => (turn, sum(&shift, &own)),
        };
        Twist { turn, shift }
    }
}

impl<S: Scalar> Chain<S> {
    pub(super) fn velocities(&self, at: &[Displacement<S>], qd: &[S]) -> Vec<Twist<S>> {
        let rates = self.rates(qd);
        let base = Twist {
            turn: self.spin[0].clone(),
            ..Twist::rest()
        };
        self.outward(base, |i, before: &Twist<S>| {
            before.next(&self.links[i], &at[i], &rates[i])
        })
    }

    /// Returns T, link by link: ½ m v·v + v·(ω × ∫ r dm) + ½ ω·(I ω), and what the rotors have.
    pub fn kinetic_energy(&self, at: &[Displacement<S>], qd: &[S]) -> S {
        let velocities = self.velocities(at, qd);
        let mut energy = S::zero();
        for ((link, velocity), rate) in self.links.iter().zip(&velocities).zip(qd) {
            let (omega, origin) = (&velocity.turn, &velocity.shift);
            let body = &link.body;
            let half = body.tensor().map(halved);
            let spin = tensor_times(&half, omega);
            let slide = scaled(&halved(&body.mass), origin);
            let slide = sum(&slide, &cross(omega, &body.first));
            energy = plus(&energy, &plus(&dot(omega, &spin), &dot(origin, &slide)));
            let rotor = times(&halved(&link.armature), rate);
            energy = plus(&energy, &times(&rotor, rate));
        }
        energy
    }

    /// Returns D q̇ and ∂T/∂q, each of length n.
    ///
    /// Turning all that follows joint k by itself leaves it as it is but for
    /// what arrives from before: its velocity changes by V × Δ_k, V being that
    /// of the joint's frame, and T by the composite momentum along that.
    pub fn momentum(&self, at: &[Displacement<S>], qd: &[S]) -> [Vec<S>; 2] {
        let velocities = self.velocities(at, qd);
        let whole = |i: usize, outer: Option<Wrench<S>>| {
            let mut wrench = outer.unwrap_or_else(Wrench::zero);
            let (omega, origin) = (&velocities[i].turn, &velocities[i].shift);
            let link = &self.links[i];
            let body = &link.body;
            let own = sum(&scaled(&body.mass, origin), &cross(omega, &body.first));
            wrench.force = sum(&wrench.force, &own);
            let own = tensor_times(&body.tensor(), omega);
            wrench.moment = sum(&wrench.moment, &sum(&own, &cross(&body.first, origin)));
            let load = self.load(i, &wrench);
            let (push, spin) = (&wrench.force, &wrench.moment);
            let momentum = plus(&load, &times(&link.armature, &qd[i]));
            let slope = match link.kind {
                // (a × z)·b = a_y b_x − a_x b_y
                JointKind::Revolute => plus(
                    &minus(&times(&omega[1], &spin[0]), &times(&omega[0], &spin[1])),
                    &minus(&times(&origin[1], &push[0]), &times(&origin[0], &push[1])),
                ),
                JointKind::Prismatic => {
                    times(&dot(&cross(omega, &link.axis), push), &self.per_unit)
                }
            };
            (wrench, (momentum, slope))
        };
        let back = |i: usize, wrench: Wrench<S>| self.to_previous(i, at, &wrench);
        let (joints, _) = self.inward(whole, back, Wrench::with);
        let (momenta, slopes) = joints.into_iter().unzip();
        [momenta, slopes]
    }
}
