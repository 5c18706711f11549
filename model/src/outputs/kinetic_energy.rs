//! T = ½ q̇ᵀ D q̇, the kinetic energy.

use alloc::vec;
use alloc::vec::Vec;

use super::formula::Formula;
use super::function::Definition;
use super::quantity::Facts;
use super::{Argument, PayloadDependence, Quantity, Regrouped, Shape, Written};
use crate::scalar::Divide;

pub(super) const FUNCTION: Definition = Definition {
    name: "kinetic_energy",
    summary: "Kinetic energy T = ½ q̇ᵀ D q̇ in joules, the rotors' part included.",
    results: &[Quantity::KineticEnergy],
    ..Definition::PLAIN
};

/// T
pub(super) struct KineticEnergy;

impl Formula for KineticEnergy {
    const FACTS: Facts = Facts {
        field: "kinetic",
        letter: "T",
        symbol: "T",
        summary: "Kinetic energy T.",
        arguments: &[Argument::Position, Argument::Velocity],
        shape: Shape::SCALAR,
        unit: |_| "J",
        given: Some("kinetic"),
        choices: Some(&[]),
        payload_dependence: PayloadDependence::Torque,
        ..Facts::PLAIN
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let energy = at.formulation.kinetic_energy(at.arm, at.at, &at.motion.qd);
        vec![energy]
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        Some(vec![at.chain.kinetic_energy(at.at, &at.motion.qd)])
    }
}
