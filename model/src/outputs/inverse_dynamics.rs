//! τ = D q̈ + h + c + b∘q̇ (eq. 2.3).

use alloc::vec::Vec;

use super::formula::Formula;
use super::function::Definition;
use super::quantity::{Facts, load};
use super::{Argument, ErrorScale, PayloadDependence, Quantity, Regrouped, Shape, Written};
use crate::equations::chain::Choice;
use crate::equations::matrix::{Vector, zero_vector};
use crate::scalar::{Divide, Scalar};

pub(super) const FUNCTION: Definition = Definition {
    name: "inverse_dynamics",
    summary: "Inverse dynamics: the joint torques (forces) τ = D q̈ + h + c + b∘q̇.",
    results: &[Quantity::Torque],
    by_default: true,
    ..Definition::PLAIN
};

/// τ_i
pub(super) struct Torque;

/// Returns the part of τ that the links of a chain take under this gravity.
pub(super) fn loads<S: Scalar>(at: &Regrouped<'_, S>, gravity: &Vector<S>, qdd: &[S]) -> Vec<S> {
    let motion = [&at.motion.qd[..], qdd];
    (at.composite).loads(gravity, motion, &zero_vector(), at.form.composite_h)
}

/// Returns τ of a chain at its velocities and these accelerations.
pub(super) fn torques<S: Scalar>(at: &Regrouped<'_, S>, qdd: &[S]) -> Vec<S> {
    let motion = [&at.motion.qd[..], qdd];
    at.chain
        .with_drives(&loads(at, &at.chain.gravity, qdd), motion)
}

impl Formula for Torque {
    const FACTS: Facts = Facts {
        field: "tau",
        letter: "τ",
        symbol: "τ",
        summary: "Torques τ.",
        arguments: &Argument::STATE,
        shape: Shape::VECTOR,
        unit: load,
        scale: ErrorScale::Load,
        given: Some("tau"),
        choices: Some(&[Choice::CompositeH]),
        starts_from_recursion: true,
        payload_dependence: PayloadDependence::Torque,
        gravity: true,
        ..Facts::PLAIN
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let motion = at.motion;
        at.formulation
            .inverse_dynamics(at.arm, at.at, &motion.qd, &motion.qdd)
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        Some(torques(at, &at.motion.qdd))
    }
}
