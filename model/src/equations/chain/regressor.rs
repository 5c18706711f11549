//! The columns of a regressor: what bodies that are fixed to the links take of
//! torque, each by itself, at one motion.
//!
//! ω, ω̇, U and v̇ of a link are the same for whatever is fixed to it, and so are
//! the joints' twists Δ_k seen from its frame. With F = m v̇ + U s and
//! N = s × v̇ + (the antisymmetric part of U Σ) of a body, its entry in row k ≤ i
//! is the power of that wrench on Δ_k. A unit body has a single moment, so that
//! a column of U or two are all that there is of its wrench.

use alloc::vec::Vec;

use super::probe::Probed;
use super::recursion::{AccelerationForm, MomentForm};
use super::twist::Twist;
use super::{Chain, Displacement, unit_z};
use crate::equations::matrix::{times, zero_vector, zeros};
use crate::robot::JointKind;
use crate::scalar::Scalar;

impl<S: Scalar> Chain<S> {
    /// The columns that the probes are, a row a joint.
    pub fn regressor(&self, at: &[Displacement<S>], qd: &[S], qdd: &[S]) -> Vec<Vec<S>> {
        let motions = self.motions(at, qd, qdd, AccelerationForm::Column);
        let n = self.links.len();
        let mut rows: Vec<Vec<S>> = (0..n).map(|_| zeros(self.columns)).collect();
        // The joints' twists up to the link's own, seen from its frame.
        let mut twists: Vec<Twist<S>> = Vec::with_capacity(n);
        for (i, link) in self.links.iter().enumerate() {
            twists = twists.iter().map(|t| t.outward(link, &at[i])).collect();
            twists.push(match link.kind {
                JointKind::Revolute => Twist {
                    turn: unit_z(),
                    shift: zero_vector(),
                },
                JointKind::Prismatic => Twist {
                    turn: zero_vector(),
                    shift: link.axis.clone(),
                },
            });
            for probe in &link.probes {
                match &probe.of {
                    Probed::Armature => rows[i][probe.column] = qdd[i].clone(),
                    Probed::Viscous => rows[i][probe.column] = qd[i].clone(),
                    Probed::Body(body) => {
                        let (force, moment) = motions[i].wrench(body, MomentForm::SecondMoments);
                        for (k, twist) in twists.iter().enumerate() {
                            let power = twist.power(&force, &moment);
                            rows[k][probe.column] = match self.links[k].kind {
                                JointKind::Revolute => power,
                                JointKind::Prismatic => times(&power, &self.per_unit),
                            };
                        }
                    }
                }
            }
        }
        rows
    }
}
