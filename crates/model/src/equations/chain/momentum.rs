//! Energies and momenta of a chain: what a link's motion is, not what changes it.

use alloc::vec::Vec;

use super::derivatives::inertial;
use super::{Chain, ChainLink, Displacement, MomentBody, Posture};
use crate::equations::matrix::*;
use crate::equations::screws::{Twist, Wrench};
use crate::robot::JointKind;
use crate::scalar::Scalar;

impl<S: Scalar> Twist<S> {
    fn next(&self, link: &ChainLink<S>, at: &Displacement<S>, rate: &S) -> Self {
        let carried = sum(&self.shift, &cross(&self.turn, &link.lever(at)));
        let along_axis = scaled(rate, &link.axis);
        let (turn, shift) = (link.inward(at, &self.turn), link.inward(at, &carried));
        let (turn, shift) = match link.kind {
            JointKind::Revolute => (sum(&turn, &along_axis), shift),
            JointKind::Prismatic => (turn, sum(&shift, &along_axis)),
        };
        Twist { turn, shift }
    }
}

/// Returns ½ m v·v + v·(ω × ∫ r dm) + ½ ω·(I ω)
fn energy_of<S: Scalar>(body: &MomentBody<S>, velocity: &Twist<S>) -> S {
    let (omega, origin) = (&velocity.turn, &velocity.shift);
    let half = body.tensor().map(halved);
    let spin = tensor_times(&half, omega);
    let slide = scaled(&halved(&body.mass), origin);
    let slide = sum(&slide, &cross(omega, &body.first));
    plus(&dot(omega, &spin), &dot(origin, &slide))
}

impl<S: Scalar> Chain<S> {
    /// Returns the velocities of the links, from that of the base.
    pub(super) fn velocities(&self, at: &Posture<S>, base: Twist<S>, qd: &[S]) -> Vec<Twist<S>> {
        let rates = self.rates(qd);
        self.outward(base, |i, before: &Twist<S>| {
            before.next(&self.links[i], &at[i], &rates[i])
        })
    }

    /// Returns T, link by link, and what the rotors have.
    pub fn kinetic_energy(&self, at: &Posture<S>, qd: &[S]) -> S {
        let base = self.base_twist(qd);
        let mut energy = match &self.base {
            None => S::zero(),
            Some(body) => energy_of(body, &base),
        };
        let velocities = self.velocities(at, base, qd);
        let joints = self.links.iter().zip(&velocities);
        for ((link, velocity), rate) in joints.zip(self.of_joints(qd)) {
            energy = plus(&energy, &energy_of(&link.body, velocity));
            let rotor = times(&halved(&link.armature), rate);
            energy = plus(&energy, &times(&rotor, rate));
        }
        energy
    }

    /// Returns D q̇ and ∂T/∂q, each an entry a coordinate.
    ///
    /// Turning all that follows joint k by itself leaves it as it is but for what arrives from
    /// before: its velocity changes by V × Δ_k, V that of the joint's frame, and T by the composite
    /// momentum along that. The momentum of the whole turns the other way in a floating base's axes.
    pub fn momentum(&self, at: &Posture<S>, qd: &[S]) -> [Vec<S>; 2] {
        let base = self.base_twist(qd);
        let velocities = self.velocities(at, base.clone(), qd);
        let joint_rates = self.of_joints(qd);
        let whole = |i: usize, outer: Option<Wrench<S>>| {
            let mut wrench = outer.unwrap_or_else(Wrench::zero);
            let (omega, origin) = (&velocities[i].turn, &velocities[i].shift);
            let link = &self.links[i];
            wrench = wrench.with(&inertial(&link.body, &velocities[i]));
            let load = self.load(i, &wrench);
            let (push, spin) = (&wrench.force, &wrench.moment);
            let momentum = plus(&load, &times(&link.armature, &joint_rates[i]));
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
        let (joints, arrived) = self.inward(whole, back, Wrench::with);
        let (mut momenta, mut slopes): (Vec<S>, Vec<S>) = joints.into_iter().unzip();
        if let Some(body) = &self.base {
            let arrived = arrived.unwrap_or_else(Wrench::zero);
            let momentum = arrived.with(&inertial(body, &base));
            let turned = momentum.turned(&base).in_axes(opposite);
            momenta.splice(..0, self.on_base(&momentum));
            slopes.splice(..0, self.on_base(&turned));
        }
        [momenta, slopes]
    }
}
