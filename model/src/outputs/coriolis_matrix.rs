//! C, the Coriolis matrix of the Christoffel symbols.

use alloc::vec::Vec;

use super::formula::Formula;
use super::function::Definition;
use super::quantity::{Choice, Facts, turns};
use super::{Argument, PayloadDependence, Quantity, Regrouped, Shape, Written};
use crate::equations::energy::contracted;
use crate::scalar::Divide;

pub(super) const FUNCTION: Definition = Definition {
    name: "coriolis_matrix",
    summary: "Coriolis matrix C(q, q̇) of the Christoffel symbols: C q̇ = h, and Ḋ - 2C is skew.",
    results: &[Quantity::CoriolisMatrix],
    ..Definition::PLAIN
};

/// C_ik = Σ_m h_ikm q̇_m
pub(super) struct CoriolisMatrix;

impl Formula for CoriolisMatrix {
    const FACTS: Facts = Facts {
        field: "c_matrix",
        letter: "C",
        symbol: "C",
        summary: "Coriolis matrix C.",
        arguments: &[Argument::Position, Argument::Velocity],
        shape: Shape::MATRIX,
        unit: |at| match turns(at) {
            0 => "N·s/m",
            1 => "N·s",
            _ => "N·m·s",
        },
        choices: Some(&[Choice::Flows]),
        by_differences: true,
        payload_dependence: PayloadDependence::Torque,
        ..Facts::PLAIN
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let c = at.formulation.coriolis_matrix(at.arm, at.at, &at.motion.qd);
        c.into_iter().flatten().collect()
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        let qd = &at.motion.qd;
        let c = match at.form.flows {
            true => at.composite.coriolis_matrix(qd, at.form.travel),
            false => contracted(&at.composite.christoffel(), qd),
        };
        Some(c.into_iter().flatten().collect())
    }
}
