//! τ = D q̈ + h + c + b∘q̇ (eq. 2.3).

use alloc::vec::Vec;

use super::formula::Formula;
use super::function::Definition;
use super::quantity::{Choice, Facts, load};
use super::{Argument, ErrorScale, PayloadDependence, Quantity, Regrouped, Shape, Written};
use crate::equations::matrix::{plus, times, zero_vector};
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

/// Returns τ of a chain at its velocities and these accelerations.
pub(super) fn torques<S: Scalar>(at: &Regrouped<'_, S>, qdd: &[S]) -> Vec<S> {
    let (chain, qd, form) = (at.chain, &at.motion.qd, at.form);
    if !form.composite_h {
        return chain.inverse_dynamics(at.at, qd, qdd, form.spin, form.couple);
    }
    let (gravity, exerted) = (&chain.gravity, zero_vector());
    let torques = at.composite.torques(gravity, qd, qdd, form.spin, &exerted);
    let links = chain.links.iter().zip(torques).enumerate();
    let torques = links.map(|(i, (link, torque))| {
        let drive = plus(
            &times(&link.armature, &qdd[i]),
            &link.friction.torque(&qd[i]),
        );
        plus(&torque, &drive)
    });
    torques.collect()
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
        choices: Some(&[Choice::Recursion]),
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
