//! D a + C v + c + b∘v: what passivity-based controllers (Slotine and Li) ask
//! of a model, with v and a the velocity and the acceleration wished for.

use alloc::vec::Vec;

use super::formula::Formula;
use super::function::Definition;
use super::quantity::{Facts, load};
use super::{Argument, ErrorScale, PayloadDependence, Quantity, Regrouped, Shape, Written};
use crate::scalar::Divide;

pub(super) const FUNCTION: Definition = Definition {
    name: "passivity",
    summary: "Passivity-based control: D a + C v + c + b∘v, with C of the Christoffel symbols.",
    results: &[Quantity::Passivity],
    ..Definition::PLAIN
};

/// The arguments of it and of its regressor.
pub(super) const ARGUMENTS: &[Argument] = &[
    Argument::Position,
    Argument::Velocity,
    Argument::ReferenceVelocity,
    Argument::ReferenceAcceleration,
];

/// (D a + C v + c + b∘v)_i
pub(super) struct Passivity;

impl Formula for Passivity {
    const FACTS: Facts = Facts {
        field: "tau",
        letter: "τ",
        symbol: "D a + C v + c + b∘v",
        summary: "Torques D a + C v + c + b∘v.",
        arguments: ARGUMENTS,
        shape: Shape::VECTOR,
        unit: load,
        scale: ErrorScale::Load,
        choices: Some(&[]),
        by_differences: true,
        payload_dependence: PayloadDependence::Torque,
        gravity: true,
        ..Facts::PLAIN
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let motion = at.motion;
        let wished = [&motion.v[..], &motion.a[..]];
        at.formulation.passivity(at.arm, at.at, &motion.qd, wished)
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        let motion = at.motion;
        let torques = at.chain.passivity(at.at, &motion.qd, &motion.v, &motion.a);
        Some(torques)
    }
}
