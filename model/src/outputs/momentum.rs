//! p = D q̇ and ∂T/∂q = Cᵀq̇, what an observer of disturbances integrates:
//! ṗ = τ + Cᵀq̇ − c − b∘q̇.

use alloc::vec::Vec;

use super::formula::Formula;
use super::function::Definition;
use super::quantity::{Facts, load, turns};
use super::{Argument, PayloadDependence, Quantity, Regrouped, Shape, Written};
use crate::scalar::Divide;

pub(super) const FUNCTION: Definition = Definition {
    name: "momentum",
    summary: "Momentum p = D q̇ and its slope Cᵀq̇ = ∂T/∂q: ṗ = τ + Cᵀq̇ - c - b∘q̇.",
    results: &[Quantity::Momentum, Quantity::MomentumSlope],
    structure: Some("Momentum"),
    ..Definition::PLAIN
};

/// p_i
pub(super) struct Momentum;

impl Formula for Momentum {
    const FACTS: Facts = Facts {
        field: "p",
        letter: "p",
        symbol: "p",
        summary: "Momentum p = D q̇.",
        arguments: &[Argument::Position, Argument::Velocity],
        shape: Shape::VECTOR,
        unit: |at| match turns(at) {
            0 => "kg·m/s",
            _ => "kg·m²/s",
        },
        choices: Some(&[]),
        payload_dependence: PayloadDependence::Torque,
        ..Facts::PLAIN
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        at.formulation.momentum(at.arm, at.at, &at.motion.qd)
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        let [p, _] = at.chain.momentum(at.at, &at.motion.qd);
        Some(p)
    }
}

/// (Cᵀq̇)_i
pub(super) struct MomentumSlope;

impl Formula for MomentumSlope {
    const FACTS: Facts = Facts {
        field: "ct_qd",
        letter: "s",
        symbol: "Cᵀq̇",
        summary: "Its slope Cᵀq̇ = ∂T/∂q.",
        arguments: &[Argument::Position, Argument::Velocity],
        shape: Shape::VECTOR,
        unit: load,
        choices: Some(&[]),
        payload_dependence: PayloadDependence::Torque,
        ..Facts::PLAIN
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        at.formulation.momentum_slope(at.arm, at.at, &at.motion.qd)
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        let [_, slope] = at.chain.momentum(at.at, &at.motion.qd);
        Some(slope)
    }
}
