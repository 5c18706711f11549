//! The second derivatives of λᵀτ and of λᵀq̈(q, q̇, τ) for a given λ.
//!
//! By those of λᵀτ optimisers of second order bend what τ is linearised by. Those of λᵀq̈ are what
//! differential dynamic programming adds to ∂q̈/∂q, ∂q̈/∂q̇ and ∂q̈/∂τ, with λ the slope of the
//! cost to go; by τ and q̇, and by τ and τ, they vanish.

use alloc::vec::Vec;

use super::derivatives::defect;
use super::formula::Formula;
use super::forward_dynamics::accelerations;
use super::operational::factor;
use super::quantity::{Facts, Index, by_turns, kilograms, turns};
use super::{Argument, Regrouped, Written};
use crate::equations::chain::Unknowns;
use crate::equations::chain::second_derivatives::SecondDerivatives;
use crate::equations::derivatives::OfAccelerations;
use crate::equations::factor::{picked, scatter};
use crate::equations::forward::{free, hold};
use crate::equations::matrix::products;
use crate::scalar::Divide;

pub(super) struct TorqueByPositions;
pub(super) struct TorqueByPositionAndVelocity;
pub(super) struct TorqueByVelocities;
pub(super) struct TorqueByAccelerationAndPosition;

fn of_torques<'a, S: Divide>(at: &'a Regrouped<'_, S>) -> &'a SecondDerivatives<S> {
    let motion = at.motion;
    let inputs = [&motion.qd[..], &motion.qdd, &motion.multiplier];
    let derivatives = || at.composite.second_derivatives(inputs, at.form.travel);
    at.shared[0].get_or_init(derivatives)
}

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
        ..Facts::MATRIX
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let (motion, form) = (at.motion, at.formulation);
        let inputs = [&motion.qd[..], &motion.qdd, &motion.multiplier];
        form.torque_by_positions(at.arm, at.at, inputs).concat()
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        Some(of_torques(at).position.concat())
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
        ..Facts::MATRIX
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let (motion, form) = (at.motion, at.formulation);
        let inputs = [&motion.qd[..], &motion.multiplier];
        form.torque_by_position_and_velocity(at.arm, at.at, inputs)
            .concat()
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        Some(of_torques(at).mixed.concat())
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
        let inputs = [&motion.qd[..], &motion.multiplier];
        form.torque_by_velocities(at.arm, at.at, inputs).concat()
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        Some(of_torques(at).velocity.concat())
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
        ..Facts::MATRIX
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let (motion, form) = (at.motion, at.formulation);
        form.torque_by_acceleration_and_position(at.arm, at.at, &motion.multiplier)
            .concat()
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        Some(of_torques(at).driven.concat())
    }
}

pub(super) struct AccelerationByPositions;
pub(super) struct AccelerationByPositionAndVelocity;
pub(super) struct AccelerationByVelocities;
pub(super) struct AccelerationByTorqueAndPosition;

/// D⁻¹ as written, and μ = D⁻¹λ.
struct InverseTerms<S> {
    inverse: Vec<Vec<S>>,
    raised: Vec<S>,
}

impl<S: Divide> InverseTerms<S> {
    fn new(at: &Written<'_, S>) -> Self {
        let (form, motion) = (at.formulation, at.motion);
        let inverse = form.inertia_inverse(at.arm, at.at, &motion.moves);
        let raised = products(&inverse, &motion.multiplier);
        InverseTerms { inverse, raised }
    }

    fn driven(&self, at: &Written<'_, S>) -> Vec<Vec<S>> {
        at.formulation
            .torque_by_acceleration_and_position(at.arm, at.at, &self.raised)
    }

    fn of_accelerations<'a>(&self, at: &Written<'a, S>) -> OfAccelerations<'a, S> {
        let by_inverse = |values: &[S]| products(&self.inverse, values);
        OfAccelerations::new(&self.driven(at), by_inverse, &at.motion.moves)
    }
}

fn of_accelerations<'a, S: Divide>(at: &'a Regrouped<'_, S>) -> &'a SecondDerivatives<S> {
    let (motion, travel) = (at.motion, at.form.travel);
    let derivatives = || {
        let (factor, free) = (factor(at), free(&motion.moves));
        let by_inverse =
            |values: &[S]| scatter(&factor.solve(&picked(values, &free)), &free, values.len());
        let qdd = accelerations(at, Unknowns::Joints);
        let raised = by_inverse(&motion.multiplier);
        let inputs = [&motion.qd[..], &qdd, &raised];
        let torque_derivatives = at.composite.second_derivatives(inputs, travel);
        let slopes = at.composite.slopes(&motion.qd, &qdd, travel);
        let terms = OfAccelerations::new(&torque_derivatives.driven, by_inverse, &motion.moves);
        SecondDerivatives {
            position: terms.by_positions(&torque_derivatives.position, &slopes.position),
            mixed: terms.by_position_and_velocity(&torque_derivatives.mixed, &slopes.velocity),
            velocity: terms.by_velocities(&torque_derivatives.velocity),
            driven: terms.by_torque_and_position(),
        }
    };
    at.shared[1].get_or_init(derivatives)
}

impl Formula for AccelerationByPositions {
    const FACTS: Facts = Facts {
        field: "d2qdd_dq_dq",
        letter: "q̈qq",
        symbol: "∂²(λᵀq̈)/∂q∂q",
        summary: "∂²(λᵀq̈)/∂q∂q, symmetric.",
        arguments: &[
            Argument::Position,
            Argument::Velocity,
            Argument::Torque,
            Argument::Multiplier,
        ],
        unit: |at| by_turns(turns(at), ["1/(m²·s²)", "1/(m·s²)", "1/s²"]),
        given: Some("d2qdd_dq_dq"),
        inverts_inertia: true,
        gravity: true,
        ..Facts::MATRIX
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let (motion, form) = (at.motion, at.formulation);
        let (qd, inverted) = (&motion.qd, InverseTerms::new(at));
        let qdd = form.forward_dynamics(at.arm, at.at, qd, &motion.tau, &motion.moves);
        let curvatures = form.torque_by_positions(at.arm, at.at, [qd, &qdd, &inverted.raised]);
        let slopes = form.torque_by_position(at.arm, at.at, qd, &qdd);
        let terms = inverted.of_accelerations(at);
        terms.by_positions(&curvatures, &slopes).concat()
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        Some(of_accelerations(at).position.concat())
    }
}

impl Formula for AccelerationByPositionAndVelocity {
    const FACTS: Facts = Facts {
        field: "d2qdd_dq_dqd",
        letter: "q̈qv",
        symbol: "∂²(λᵀq̈)/∂q∂q̇",
        summary: "∂²(λᵀq̈)/∂q∂q̇: row i has the slopes by q̇ of ∂(λᵀq̈)/∂q_i.",
        arguments: &[Argument::Position, Argument::Velocity, Argument::Multiplier],
        unit: |at| by_turns(turns(at), ["1/(m²·s)", "1/(m·s)", "1/s"]),
        given: Some("d2qdd_dq_dqd"),
        inverts_inertia: true,
        ..Facts::MATRIX
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let (form, qd, inverted) = (at.formulation, &at.motion.qd, InverseTerms::new(at));
        let inputs = [&qd[..], &inverted.raised];
        let curvatures = form.torque_by_position_and_velocity(at.arm, at.at, inputs);
        let slopes = form.torque_by_velocity(at.arm, at.at, qd);
        let terms = inverted.of_accelerations(at);
        terms
            .by_position_and_velocity(&curvatures, &slopes)
            .concat()
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        Some(of_accelerations(at).mixed.concat())
    }
}

impl Formula for AccelerationByVelocities {
    const FACTS: Facts = Facts {
        field: "d2qdd_dqd_dqd",
        letter: "q̈vv",
        symbol: "∂²(λᵀq̈)/∂q̇∂q̇",
        summary: "∂²(λᵀq̈)/∂q̇∂q̇, symmetric.",
        unit: |at| by_turns(turns(at), ["1/m²", "1/m", "1"]),
        given: Some("d2qdd_dqd_dqd"),
        ..AccelerationByPositionAndVelocity::FACTS
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let (form, inverted) = (at.formulation, InverseTerms::new(at));
        let inputs = [&at.motion.qd[..], &inverted.raised];
        let curvatures = form.torque_by_velocities(at.arm, at.at, inputs);
        let terms = inverted.of_accelerations(at);
        terms.by_velocities(&curvatures).concat()
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        Some(of_accelerations(at).velocity.concat())
    }
}

impl Formula for AccelerationByTorqueAndPosition {
    const FACTS: Facts = Facts {
        field: "d2qdd_dtau_dq",
        letter: "q̈τq",
        symbol: "∂²(λᵀq̈)/∂τ∂q",
        summary: "∂²(λᵀq̈)/∂τ∂q = ∂(D⁻¹λ)/∂q: row i has the slopes of (D⁻¹λ)_i.",
        arguments: &[Argument::Position, Argument::Multiplier],
        unit: |at| match at {
            [Index::Turning, Index::Turning] => "1/(kg·m²)",
            [Index::Turning, _] => "1/(kg·m³)",
            [_, Index::Turning] => "1/(kg·m)",
            _ => "1/(kg·m²)",
        },
        given: Some("d2qdd_dtau_dq"),
        inverts_inertia: true,
        ..Facts::MATRIX
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let terms = InverseTerms::new(at).of_accelerations(at);
        terms.by_torque_and_position().concat()
    }

    /// Returns D X + ∂(D μ)/∂q with D μ = λ, of the joints that move.
    fn residual<S: Divide>(at: &Written<'_, S>, values: &[S]) -> Vec<S> {
        let mut driven = InverseTerms::new(at).driven(at);
        hold(&mut driven, &at.motion.moves);
        defect(at, values, &driven)
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        Some(of_accelerations(at).driven.concat())
    }
}
