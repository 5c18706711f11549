//! U = −Σ m g·r, the potential energy.

use alloc::vec;
use alloc::vec::Vec;

use super::formula::Formula;
use super::function::Definition;
use super::quantity::Facts;
use super::{Argument, PayloadDependence, Quantity, Shape, Written};
use crate::scalar::Divide;

pub(super) const FUNCTION: Definition = Definition {
    name: "potential_energy",
    summary: "Potential energy U = -Σ m g·r in joules, r from the base's origin.",
    results: &[Quantity::PotentialEnergy],
    ..Definition::PLAIN
};

/// U
pub(super) struct PotentialEnergy;

impl Formula for PotentialEnergy {
    const FACTS: Facts = Facts {
        field: "potential",
        letter: "U",
        symbol: "U",
        summary: "Potential energy U.",
        arguments: &[Argument::Position],
        shape: Shape::SCALAR,
        unit: |_| "J",
        given: Some("potential"),
        depends_on_base: true,
        payload_dependence: PayloadDependence::Full,
        gravity: true,
        ..Facts::PLAIN
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        vec![at.formulation.potential_energy(at.arm, at.at)]
    }
}
