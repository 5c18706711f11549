//! Torques at accelerations a by which the recursion becomes short, D (q̈ − a) = τ − τ(a):
//! those that make U_12 = ω_x ω_y − ω̇_z vanish.

use alloc::vec::Vec;

use super::recursion::{AccelerationForm, Motion};
use super::{Chain, Displacement};
use crate::equations::matrix::{dot, minus, plus, times};
use crate::robot::JointKind;
use crate::scalar::Scalar;

pub(super) struct ReferenceMotion<S> {
    pub(super) accelerations: Vec<S>,
    pub(super) links: Vec<Motion<S>>,
}

impl<S: Scalar> Chain<S> {
    /// a is zero of joints that slide, and of those that do not move.
    pub(super) fn reference_motion(
        &self,
        at: &[Displacement<S>],
        qd: &[S],
        moves: &[bool],
        spin: AccelerationForm,
    ) -> ReferenceMotion<S> {
        let rates = self.rates(qd);
        let n = self.links.len();
        let mut motion = ReferenceMotion {
            accelerations: Vec::with_capacity(n),
            links: Vec::with_capacity(n),
        };
        let base = Motion::base(&self.gravity);
        for (i, link) in self.links.iter().enumerate() {
            let before = motion.links.last().unwrap_or(&base);
            let (next, acceleration) = match link.kind {
                JointKind::Revolute if moves[i] => {
                    let [x, y, _] = link.inward(&at[i], &before.omega);
                    let along = times(&x, &y);
                    let carried = dot(&link.axis_before(), &before.omega_dot);
                    let acceleration = minus(&along, &carried);
                    let next = before.next_along(link, &at[i], &rates[i], &along, spin);
                    (next, acceleration)
                }
                _ => {
                    let rest = S::zero();
                    (before.next(link, &at[i], &rates[i], &rest, spin), rest)
                }
            };
            motion.links.push(next);
            motion.accelerations.push(acceleration);
        }
        motion
    }

    pub(crate) fn drive(&self, joint: usize, qd: &[S], accelerations: &[S]) -> S {
        let link = &self.links[joint];
        let inertial = times(&link.armature, &accelerations[joint]);
        plus(&inertial, &link.friction.torque(&qd[joint]))
    }
}
