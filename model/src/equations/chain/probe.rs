//! The columns of a regressor: what bodies that are fixed to the links take of
//! torque, each by itself, at one motion.
//!
//! ω, ω̇, U and v̇ of a link are the same for whatever is fixed to it, and so are
//! the joints' twists Δ_k seen from its frame. With F = m v̇ + U s and
//! N = s × v̇ + (the antisymmetric part of U Σ) of a body, its entry in row k ≤ i
//! is the power of that wrench on Δ_k. A unit body has a single moment, so that
//! a column of U or two are all that there is of its wrench.

use alloc::vec::Vec;

use super::recursion::{AccelerationForm, MomentForm};
use super::twist::Twist;
use super::{Body, Chain, Displacement, Rotation, unit_z};
use crate::equations::matrix::{Vector, times, zero_vector, zeros};
use crate::equations::regressor::Column;
use crate::robot::JointKind;
use crate::scalar::Scalar;

/// What is fixed to a link beside its body.
#[derive(Clone, Debug)]
pub struct Probe<S> {
    /// The column of the regressor.
    pub column: usize,
    /// What it is.
    pub of: Probed<S>,
}

/// What a column of a regressor is of.
#[derive(Clone, Debug)]
pub enum Probed<S> {
    /// A body, about the origin and in the axes of the link's frame.
    Body(Body<S>),
    /// A unit of the rotor's inertia.
    Armature,
    /// A unit of viscous friction.
    Viscous,
}

impl<S> Probe<S> {
    pub(super) fn is_body(&self) -> bool {
        matches!(self.of, Probed::Body(_))
    }

    /// Every body through `f`.
    pub(super) fn each<T>(
        probes: &[Probe<S>],
        mut f: impl FnMut(&Body<S>) -> Body<T>,
    ) -> Vec<Probe<T>> {
        let each = probes.iter().map(|probe| Probe {
            column: probe.column,
            of: match &probe.of {
                Probed::Body(body) => Probed::Body(f(body)),
                Probed::Armature => Probed::Armature,
                Probed::Viscous => Probed::Viscous,
            },
        });
        each.collect()
    }
}

/// The columns of a joint, from its DH frame into a frame in which that is
/// turned and moved.
pub(super) fn probes<S: Scalar>(
    columns: &[Column<S>],
    joint: usize,
    turned: &Rotation<S>,
    moved: &Vector<S>,
) -> impl Iterator<Item = Probe<S>> {
    let of = move |column: &Column<S>| match column {
        Column::Body { joint: own, body } => {
            (*own == joint).then(|| Probed::Body(body.carried(turned, moved)))
        }
        Column::Armature(own) => (*own == joint).then_some(Probed::Armature),
        Column::Viscous(own) => (*own == joint).then_some(Probed::Viscous),
    };
    let all = columns.iter().enumerate();
    all.filter_map(move |(column, what)| {
        Some(Probe {
            column,
            of: of(what)?,
        })
    })
}

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
