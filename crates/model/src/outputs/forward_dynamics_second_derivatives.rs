//! The second derivatives of λᵀq̈(q, q̇, τ) for a given λ: what differential dynamic
//! programming adds to ∂q̈/∂q, ∂q̈/∂q̇ and ∂q̈/∂τ, with λ the slope of the cost to go.
//! By τ and q̇, and by τ and τ, they vanish.

use alloc::vec::Vec;

use super::derivatives::defect;
use super::formula::Formula;
use super::forward_dynamics::accelerations;
use super::inverse_dynamics_second_derivatives::SHARED;
use super::operational::factor;
use super::quantity::{Facts, Index, by_turns, turns};
use super::{Argument, Regrouped, Written};
use crate::equations::chain::Unknowns;
use crate::equations::chain::second_derivatives::SecondDerivatives;
use crate::equations::factor::scatter;
use crate::equations::forward::free;
use crate::equations::matrix::products;
use crate::equations::second_derivatives::OfAccelerations;
use crate::scalar::Divide;

pub(super) struct AccelerationByPositions;

pub(super) struct AccelerationByPositionAndVelocity;

pub(super) struct AccelerationByVelocities;

pub(super) struct AccelerationByTorqueAndPosition;

/// D⁻¹ as written, and μ = D⁻¹λ.
struct Inverted<S> {
    inverse: Vec<Vec<S>>,
    raised: Vec<S>,
}

impl<S: Divide> Inverted<S> {
    fn new(at: &Written<'_, S>) -> Self {
        let inverse = at
            .formulation
            .inertia_inverse(at.arm, at.at, &at.motion.moves);
        let raised = products(&inverse, &at.motion.multiplier);
        Inverted { inverse, raised }
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

fn regrouped<'a, S: Divide>(at: &'a Regrouped<'_, S>) -> &'a SecondDerivatives<S> {
    let (motion, travel) = (at.motion, at.form.travel);
    let all = || {
        let (factor, free) = (factor(at), free(&motion.moves));
        let by_inverse = |values: &[S]| {
            let load: Vec<S> = free.iter().map(|&i| values[i].clone()).collect();
            scatter(&factor.solve(&load), &free, values.len())
        };
        let qdd = accelerations(at, Unknowns::Joints);
        let raised = by_inverse(&motion.multiplier);
        let given = [&motion.qd[..], &qdd, &raised];
        let own = at.composite.second_derivatives(given, travel);
        let slopes = at.composite.slopes(&motion.qd, &qdd, travel);
        let all = OfAccelerations::new(&own.driven, by_inverse, &motion.moves);
        SecondDerivatives {
            position: all.by_positions(&own.position, &slopes.position),
            mixed: all.by_position_and_velocity(&own.mixed, &slopes.velocity),
            velocity: all.by_velocities(&own.velocity),
            driven: all.by_torque_and_position(),
        }
    };
    at.shared[1].get_or_init(all)
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
        ..SHARED
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let (motion, form) = (at.motion, at.formulation);
        let (qd, inverted) = (&motion.qd, Inverted::new(at));
        let qdd = form.forward_dynamics(at.arm, at.at, qd, &motion.tau, &motion.moves);
        let own = form.torque_by_positions(at.arm, at.at, [qd, &qdd, &inverted.raised]);
        let slopes = form.torque_by_position(at.arm, at.at, qd, &qdd);
        let all = inverted.of_accelerations(at);
        all.by_positions(&own, &slopes).concat()
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        Some(regrouped(at).position.concat())
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
        ..SHARED
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let (form, qd, inverted) = (at.formulation, &at.motion.qd, Inverted::new(at));
        let given = [&qd[..], &inverted.raised];
        let own = form.torque_by_position_and_velocity(at.arm, at.at, given);
        let slopes = form.torque_by_velocity(at.arm, at.at, qd);
        let all = inverted.of_accelerations(at);
        all.by_position_and_velocity(&own, &slopes).concat()
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        Some(regrouped(at).mixed.concat())
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
        let (form, inverted) = (at.formulation, Inverted::new(at));
        let given = [&at.motion.qd[..], &inverted.raised];
        let own = form.torque_by_velocities(at.arm, at.at, given);
        let all = inverted.of_accelerations(at);
        all.by_velocities(&own).concat()
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        Some(regrouped(at).velocity.concat())
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
        ..SHARED
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let all = Inverted::new(at).of_accelerations(at);
        all.by_torque_and_position().concat()
    }

    /// Returns D X + ∂(D μ)/∂q with D μ = λ, of the joints that move.
    fn residual<S: Divide>(at: &Written<'_, S>, values: &[S]) -> Vec<S> {
        let mut driven = Inverted::new(at).driven(at);
        for row in &mut driven {
            let held = row.iter_mut().zip(&at.motion.moves);
            held.filter(|(_, moves)| !**moves)
                .for_each(|(entry, _)| *entry = S::zero());
        }
        defect(at, values, &driven)
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        Some(regrouped(at).driven.concat())
    }
}
