//! D a + C v + c + b∘v, the torques of a passivity-based controller, in one
//! recursion over two velocities: products of components of ω become half the sum of
//! their products with those of ν, the angular velocity that v gives.

use alloc::vec::Vec;

use super::recursion::{LinkMotion, MomentForm, Motions, from_column, from_rates};
use super::{Chain, ChainLink, Displacement, Posture};
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
    motion: LinkMotion<S>,
}

impl<S: Scalar> Mixed<S> {
    fn next(&self, link: &ChainLink<S>, at: &Displacement<S>, rates: [&S; 3]) -> Self {
        let (motion, [rate, half, acceleration]) = (&self.motion, rates);
        let carried = sum(&motion.acceleration, &motion.u_times(&link.lever(at)));
        if link.kind == JointKind::Prismatic {
            let axis = &link.axis;
            // ½ (2 q̇ ν × e + 2 v ω × e), of halves.
            let mixed = sum(&scaled(rate, &self.half_nu), &scaled(half, &self.omega));
            let coriolis = cross(&mixed.each_ref().map(twice), axis);
            let joint_acceleration = sum(&coriolis, &scaled(acceleration, axis));
            let mut next = self.clone();
            next.motion.acceleration = sum(&carried, &joint_acceleration);
            return next;
        }
        let turned = |velocity: &Vector<S>, joint_rate: &S| {
            let [x, y, z] = link.inward(at, velocity);
            [x, y, plus(&z, joint_rate)]
        };
        let omega = turned(&self.omega, rate);
        let half_nu = turned(&self.half_nu, half);
        let axis = link.axis_before();
        let along = plus(&dot(&axis, &motion.omega_dot), acceleration);
        let column = link.inward(at, &motion.u_times(&axis));
        let (omega_dot, u) = from_column(mixed(&omega, &half_nu), &along, column);
        Mixed {
            motion: LinkMotion {
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

/// Returns the symmetric products of ω and ν, from ν / 2.
fn mixed<S: Scalar>(omega: &Vector<S>, half_nu: &Vector<S>) -> impl Fn(usize, usize) -> S {
    let product = move |i: usize, j: usize| times(&omega[i], &half_nu[j]);
    move |i, j| match i == j {
        true => twice(&product(i, i)),
        false => plus(&product(i, j), &product(j, i)),
    }
}

impl<S: Scalar> Chain<S> {
    /// Returns D a + C v + c + (b + F∘r)∘v, an entry a coordinate.
    pub fn passivity(&self, at: &Posture<S>, qd: &[S], v: &[S], a: &[S]) -> Vec<S> {
        let motions = self.mixed_motions(at, qd, [v, a]);
        let drive = |i: usize| self.drive(i, v, a);
        let exerted = zero_vector();
        self.torques(at, &motions, MomentForm::SecondMoments, &exerted, drive)
    }

    /// U and v̇ are bilinear in both velocities, and wrenches linear in these for any body.
    pub(super) fn mixed_motions(&self, at: &Posture<S>, qd: &[S], [v, a]: [&[S]; 2]) -> Motions<S> {
        let halves: Vec<S> = v.iter().map(halved).collect();
        let [rates, halved_rates, accelerations] = [qd, &halves, a].map(|rates| self.rates(rates));
        let base = self.mixed_base([qd, &halves, v, a]);
        let links = self.outward(base.clone(), |i, before: &Mixed<S>| {
            let rates = [&rates[i], &halved_rates[i], &accelerations[i]];
            before.next(&self.links[i], &at[i], rates)
        });
        Motions {
            base: base.motion,
            links: links.into_iter().map(|mixed| mixed.motion).collect(),
        }
    }

    /// If the base floats, C v has ω × v of the linear velocity wished for, and ω × ν / 2 beside
    /// the symmetric products.
    fn mixed_base(&self, [qd, halves, v, a]: [&[S]; 4]) -> Mixed<S> {
        let rates: Vec<S> = match self.base_coordinates() {
            0 => Vec::new(),
            _ => [&v[..3], &qd[3..6]].concat(),
        };
        let mut motion = self.base_motion([&rates, a], &self.gravity);
        let omega = core::mem::replace(&mut motion.omega, zero_vector());
        let half_nu = self.base_twist(halves).turn;
        motion.omega_dot = sum(&motion.omega_dot, &cross(&omega, &half_nu));
        motion.u = from_rates(mixed(&omega, &half_nu), &motion.omega_dot);
        Mixed {
            motion,
            omega,
            half_nu,
        }
    }
}
