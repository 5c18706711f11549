//! The second derivatives of λᵀτ for a given λ, by which optimisers of second order bend
//! what τ is linearised by.

use alloc::vec::Vec;

use super::formula::Formula;
use super::quantity::{Choice, Facts, by_turns, kilograms, turns};
use super::{Argument, PayloadDependence, Regrouped, Shape, Written};
use crate::equations::chain::second_derivatives::SecondDerivatives;
use crate::scalar::Divide;

pub(super) struct TorqueByPositions;

pub(super) struct TorqueByPositionAndVelocity;

pub(super) struct TorqueByVelocities;

pub(super) struct TorqueByAccelerationAndPosition;

fn regrouped<'a, S: Divide>(at: &'a Regrouped<'_, S>) -> &'a SecondDerivatives<S> {
    let motion = at.motion;
    let given = [&motion.qd[..], &motion.qdd, &motion.multiplier];
    let all = || at.composite.second_derivatives(given, at.form.travel);
    at.shared[0].get_or_init(all)
}

pub(super) const SHARED: Facts = Facts {
    shape: Shape::MATRIX,
    choices: Some(&[Choice::Travel]),
    payload_dependence: PayloadDependence::Torque,
    ..Facts::PLAIN
};

impl Formula for TorqueByPositions {
    const FACTS: Facts = Facts {
        field: "d2tau_dq_dq",
        letter: "τqq",
        symbol: "∂²(λᵀτ)/∂q∂q",
        summary: "∂²(λᵀτ)/∂q∂q, symmetric.",
        arguments: &[
            Argument::Position,
            Argument::Velocity,
            Argument::Acceleration,
            Argument::Multiplier,
        ],
        unit: |at| by_turns(turns(at), ["N/m", "N", "N·m"]),
        given: Some("d2tau_dq_dq"),
        gravity: true,
        ..SHARED
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let (motion, form) = (at.motion, at.formulation);
        let given = [&motion.qd[..], &motion.qdd, &motion.multiplier];
        form.torque_by_positions(at.arm, at.at, given).concat()
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        Some(regrouped(at).position.concat())
    }
}

impl Formula for TorqueByPositionAndVelocity {
    const FACTS: Facts = Facts {
        field: "d2tau_dq_dqd",
        letter: "τqv",
        symbol: "∂²(λᵀτ)/∂q∂q̇",
        summary: "∂²(λᵀτ)/∂q∂q̇: row i has the slopes by q̇ of ∂(λᵀτ)/∂q_i.",
        arguments: &[Argument::Position, Argument::Velocity, Argument::Multiplier],
        unit: |at| by_turns(turns(at), ["N·s/m", "N·s", "N·m·s"]),
        given: Some("d2tau_dq_dqd"),
        ..SHARED
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let (motion, form) = (at.motion, at.formulation);
        let given = [&motion.qd[..], &motion.multiplier];
        form.torque_by_position_and_velocity(at.arm, at.at, given)
            .concat()
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        Some(regrouped(at).mixed.concat())
    }
}

impl Formula for TorqueByVelocities {
    const FACTS: Facts = Facts {
        field: "d2tau_dqd_dqd",
        letter: "τvv",
        symbol: "∂²(λᵀτ)/∂q̇∂q̇",
        summary: "∂²(λᵀτ)/∂q̇∂q̇, symmetric.",
        unit: |at| kilograms(turns(at)),
        given: Some("d2tau_dqd_dqd"),
        ..TorqueByPositionAndVelocity::FACTS
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let (motion, form) = (at.motion, at.formulation);
        let given = [&motion.qd[..], &motion.multiplier];
        form.torque_by_velocities(at.arm, at.at, given).concat()
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        Some(regrouped(at).velocity.concat())
    }
}

impl Formula for TorqueByAccelerationAndPosition {
    const FACTS: Facts = Facts {
        field: "d2tau_dqdd_dq",
        letter: "τaq",
        symbol: "∂²(λᵀτ)/∂q̈∂q",
        summary: "∂²(λᵀτ)/∂q̈∂q = ∂(D λ)/∂q: row i has the slopes of (D λ)_i.",
        arguments: &[Argument::Position, Argument::Multiplier],
        unit: |at| kilograms(turns(at)),
        given: Some("d2tau_dqdd_dq"),
        ..SHARED
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let (motion, form) = (at.motion, at.formulation);
        form.torque_by_acceleration_and_position(at.arm, at.at, &motion.multiplier)
            .concat()
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        Some(regrouped(at).driven.concat())
    }
}
