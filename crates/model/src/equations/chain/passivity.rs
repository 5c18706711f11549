//! D a + C v + c + b∘v, the torques of a passivity-based controller, in one
//! recursion over two velocities: products of components of ω become half the sum of
//! their products with those of ν, the angular velocity that v gives.

use alloc::vec::Vec;

use super::recursion::{MomentForm, Motion, from_column};
use super::{Chain, ChainLink, Displacement};
use crate::equations::matrix::*;
use crate::robot::JointKind;
use crate::scalar::Scalar;

#[derive(Clone, Debug)]
struct Mixed<S> {
    /// ω of q̇.
    omega: Vector<S>,
    /// Half of that of v: the halves are taken once, at the joints.
    half_nu: Vector<S>,
    /// U and v̇, bilinear in the velocities; without a velocity of its own.
    motion: Motion<S>,
}

impl<S: Scalar> Mixed<S> {
    fn next(
        &self,
        link: &ChainLink<S>,
        at: &Displacement<S>,
        [rate, half, acceleration]: [&S; 3],
    ) -> Self {
        let motion = &self.motion;
        let carried = sum(&motion.acceleration, &motion.u_times(&link.lever(at)));
        if link.kind == JointKind::Prismatic {
            let axis = &link.axis;
            // ½ (2 q̇ ν × e + 2 v ω × e), of halves.
            let mixed = sum(&scaled(rate, &self.half_nu), &scaled(half, &self.omega));
            let coriolis = cross(&mixed.each_ref().map(twice), axis);
            let own = sum(&coriolis, &scaled(acceleration, axis));
            let mut next = self.clone();
            next.motion.acceleration = sum(&carried, &own);
            return next;
        }
        let turned = |velocity: &Vector<S>, own: &S| {
            let [x, y, z] = link.inward(at, velocity);
            [x, y, plus(&z, own)]
        };
        let omega = turned(&self.omega, rate);
        let half_nu = turned(&self.half_nu, half);
        let axis = link.axis_before();
        let along = plus(&dot(&axis, &motion.omega_dot), acceleration);
        let column = link.inward(at, &motion.u_times(&axis));
        let product = |i: usize, j: usize| match i == j {
            true => twice(&times(&omega[i], &half_nu[i])),
            false => plus(
                &times(&omega[i], &half_nu[j]),
                &times(&omega[j], &half_nu[i]),
            ),
        };
        let (omega_dot, u) = from_column(product, &along, column);
        Mixed {
            motion: Motion {
                omega: zero_vector(),
                omega_dot,
                u,
                acceleration: link.inward(at, &carried),
            },
            omega,
            half_nu,
        }
    }
}

impl<S: Scalar> Chain<S> {
    /// Returns D a + C v + c + (b + F∘r)∘v, length n.
    pub fn passivity(&self, at: &[Displacement<S>], qd: &[S], v: &[S], a: &[S]) -> Vec<S> {
        let motions = self.mixed_motions(at, qd, [v, a]);
        let drive = |i: usize| self.drive(i, v, a);
        let exerted = zero_vector();
        self.torques(at, &motions, MomentForm::SecondMoments, &exerted, drive)
    }

    /// U and v̇ are bilinear in both velocities, and wrenches linear in these for any body.
    pub(super) fn mixed_motions(
        &self,
        at: &[Displacement<S>],
        qd: &[S],
        [v, a]: [&[S]; 2],
    ) -> Vec<Motion<S>> {
        let halves: Vec<S> = v.iter().map(halved).collect();
        let [rates, halves, accelerations] = [qd, &halves, a].map(|rates| self.rates(rates));
        let base = Mixed {
            omega: zero_vector(),
            half_nu: zero_vector(),
            motion: Motion::base(&[zero_vector(), zero_vector()], &self.gravity),
        };
        let motions = self.outward(base, |i, before: &Mixed<S>| {
            let rates = [&rates[i], &halves[i], &accelerations[i]];
            before.next(&self.links[i], &at[i], rates)
        });
        motions.into_iter().map(|mixed| mixed.motion).collect()
    }
}
