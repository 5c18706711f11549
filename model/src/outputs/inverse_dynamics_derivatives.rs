//! ∂τ/∂q, ∂τ/∂q̇ and D = ∂τ/∂q̈: what τ is linearised by.

use alloc::vec::Vec;

use super::formula::Formula;
use super::function::Definition;
use super::quantity::{Choice, Facts, turns};
use super::{Argument, PayloadDependence, Quantity, Regrouped, Shape, Written};
use crate::scalar::Divide;

pub(super) const FUNCTION: Definition = Definition {
    name: "inverse_dynamics_derivatives",
    summary: "Derivatives of the inverse dynamics: ∂τ/∂q, ∂τ/∂q̇ and ∂τ/∂q̈ = D.",
    results: &[
        Quantity::TorqueByPosition,
        Quantity::TorqueByVelocity,
        Quantity::Inertia,
    ],
    structure: Some("InverseDynamicsDerivatives"),
    ..Definition::PLAIN
};

/// ∂τ_i/∂q_k
pub(super) struct TorqueByPosition;

impl Formula for TorqueByPosition {
    const FACTS: Facts = Facts {
        field: "dtau_dq",
        letter: "τq",
        symbol: "∂τ/∂q",
        summary: "∂τ/∂q: row i has the slopes of τ_i.",
        arguments: &Argument::STATE,
        shape: Shape::MATRIX,
        unit: |at| match turns(at) {
            0 => "N/m",
            1 => "N",
            _ => "N·m",
        },
        given: Some("dtau_dq"),
        choices: Some(&[Choice::Travel]),
        payload_dependence: PayloadDependence::Torque,
        gravity: true,
        ..Facts::PLAIN
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let motion = at.motion;
        let slopes = at
            .formulation
            .torque_by_position(at.arm, at.at, &motion.qd, &motion.qdd);
        slopes.into_iter().flatten().collect()
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        let motion = at.motion;
        let slopes = at.composite.slopes(&motion.qd, &motion.qdd, at.form.travel);
        Some(slopes.position.into_iter().flatten().collect())
    }
}

/// ∂τ_i/∂q̇_k
pub(super) struct TorqueByVelocity;

impl Formula for TorqueByVelocity {
    const FACTS: Facts = Facts {
        field: "dtau_dqd",
        letter: "τv",
        symbol: "∂τ/∂q̇",
        summary: "∂τ/∂q̇, damping on its diagonal.",
        arguments: &[Argument::Position, Argument::Velocity],
        shape: Shape::MATRIX,
        unit: |at| match turns(at) {
            0 => "N·s/m",
            1 => "N·s",
            _ => "N·m·s",
        },
        given: Some("dtau_dqd"),
        choices: Some(&[Choice::Travel]),
        payload_dependence: PayloadDependence::Torque,
        ..Facts::PLAIN
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let slopes = at
            .formulation
            .torque_by_velocity(at.arm, at.at, &at.motion.qd);
        slopes.into_iter().flatten().collect()
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        let motion = at.motion;
        let slopes = at.composite.slopes(&motion.qd, &motion.qdd, at.form.travel);
        Some(slopes.velocity.into_iter().flatten().collect())
    }
}
