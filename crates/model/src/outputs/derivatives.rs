//! Derivatives of torques and accelerations.
//!
//! With q̈ in the place of the free argument, D q̈ + h + c + b∘q̇ = τ holds for all q and q̇, so that
//! D ∂q̈/∂q = −∂τ/∂q at that q̈, and likewise for q̇.
//!
//! Second derivatives are of λᵀτ and of λᵀq̈(q, q̇, τ) for a given λ. By those of λᵀτ optimisers of
//! second order bend what τ is linearised by. Those of λᵀq̈ are what differential dynamic programming
//! adds to ∂q̈/∂q, ∂q̈/∂q̇ and ∂q̈/∂τ, with λ the slope of the cost to go; by τ and q̇, and by τ and τ,
//! they vanish.

use alloc::vec::Vec;

use super::Argument::{self, Acceleration, Multiplier, Position, Torque, Velocity};
use super::formula::Formula;
use super::forward_dynamics::{InertiaInverse, accelerations, inverse};
use super::operational::factor;
use super::quantity::{Facts, Index, by_turns, kilograms, turns};
use super::{Regrouped, Written};
use crate::equations::chain::Unknowns;
use crate::equations::chain::second_derivatives::SecondDerivatives;
use crate::equations::derivatives::OfAccelerations;
use crate::equations::factor::{picked, scatter};
use crate::equations::following::{gathered_columns, spread};
use crate::equations::forward::{against, free, hold};
use crate::equations::matrix::{Matrix, products};
use crate::scalar::Divide;

pub(super) struct TorqueByPosition;
impl Formula for TorqueByPosition {
    const FACTS: Facts = Facts {
        field: "dtau_dq",
        letter: "τq",
        symbol: "∂τ/∂q",
        summary: "∂τ/∂q: row i has the slopes of τ_i.",
        arguments: &Argument::STATE,
        unit: |at| by_turns(turns(at), ["N/m", "N", "N·m"]),
        given: Some("dtau_dq"),
        gravity: true,
        ..Facts::MATRIX
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let (form, motion) = (at.formulation, at.motion);
        form.torque_by_position(at.arm, at.at, &motion.qd, &motion.qdd)
            .concat()
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        let motion = at.motion;
        let slopes = at.composite.slopes(&motion.qd, &motion.qdd, at.form.travel);
        Some(slopes.position.concat())
    }
}

pub(super) struct TorqueByVelocity;
impl Formula for TorqueByVelocity {
    const FACTS: Facts = Facts {
        field: "dtau_dqd",
        letter: "τv",
        symbol: "∂τ/∂q̇",
        summary: "∂τ/∂q̇, damping on its diagonal.",
        arguments: &[Position, Velocity],
        unit: |at| by_turns(turns(at), ["N·s/m", "N·s", "N·m·s"]),
        given: Some("dtau_dqd"),
        ..Facts::MATRIX
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let slopes = (at.formulation).torque_by_velocity(at.arm, at.at, &at.motion.qd);
        slopes.concat()
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        let motion = at.motion;
        let slopes = at.composite.slopes(&motion.qd, &motion.qdd, at.form.travel);
        Some(slopes.velocity.concat())
    }
}

pub(super) struct AccelerationByPosition;
pub(super) struct AccelerationByVelocity;
pub(super) struct AccelerationByTorque;

fn slopes<S: Divide>(at: &Regrouped<'_, S>) -> [Vec<S>; 2] {
    let (motion, form) = (at.motion, at.form);
    let qdd = spread(at.following, accelerations(at, Unknowns::Joints));
    let inverse = inverse(at);
    let slopes = at.composite.slopes(&motion.qd, &qdd, form.travel);
    [slopes.position, slopes.velocity]
        .map(|slopes| against(&inverse, &gathered_columns(at.following, slopes)).concat())
}

fn written<S: Divide>(at: &Written<'_, S>) -> [Vec<S>; 2] {
    let (form, motion) = (at.formulation, at.motion);
    form.acceleration_slopes(at.arm, at.at, &motion.qd, &motion.tau, &motion.moves)
        .map(|slopes| slopes.concat())
}

/// Returns D X + S over the joints that move, for the slopes X of q̈ and S of τ.
pub(super) fn defect<S: Divide>(at: &Written<'_, S>, x: &[S], slopes: &[Vec<S>]) -> Vec<S> {
    let d = at.formulation.gathered_inertia(at.arm, at.at);
    let slopes = gathered_columns(&at.arm.following, slopes.to_vec());
    let (free, n) = (free(&at.motion.moves), d.len());
    let entry = |i: usize, k: usize| {
        let products = free.iter().map(|&j| d[i][j].mul(&x[j * n + k]));
        products.fold(slopes[i][k].clone(), |sum, product| sum.add(&product))
    };
    let entries = free.iter().flat_map(|&i| (0..n).map(move |k| (i, k)));
    entries.map(|(i, k)| entry(i, k)).collect()
}

impl Formula for AccelerationByPosition {
    const FACTS: Facts = Facts {
        field: "dqdd_dq",
        letter: "q̈q",
        symbol: "∂q̈/∂q",
        summary: "∂q̈/∂q: row i has the slopes of q̈_i.",
        arguments: &[Position, Velocity, Torque],
        unit: |at| match at {
            [Index::Turning, Index::Sliding] => "1/(m·s²)",
            [Index::Sliding, Index::Turning] => "m/s²",
            _ => "1/s²",
        },
        given: Some("dqdd_dq"),
        inverts_inertia: true,
        gravity: true,
        ..Facts::MATRIX
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let [position, _] = written(at);
        position
    }

    fn residual<S: Divide>(at: &Written<'_, S>, values: &[S]) -> Vec<S> {
        let (form, motion) = (at.formulation, at.motion);
        let qdd = form.forward_dynamics(at.arm, at.at, &motion.qd, &motion.tau, &motion.moves);
        let qdd = spread(&at.arm.following, qdd);
        let slopes = form.torque_by_position(at.arm, at.at, &motion.qd, &qdd);
        defect(at, values, &slopes)
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        let [position, _] = slopes(at);
        Some(position)
    }
}

impl Formula for AccelerationByVelocity {
    const FACTS: Facts = Facts {
        field: "dqdd_dqd",
        letter: "q̈v",
        symbol: "∂q̈/∂q̇",
        summary: "∂q̈/∂q̇: row i has the slopes of q̈_i.",
        unit: |at| match at {
            [Index::Turning, Index::Sliding] => "1/(m·s)",
            [Index::Sliding, Index::Turning] => "m/s",
            _ => "1/s",
        },
        given: Some("dqdd_dqd"),
        gravity: false,
        ..AccelerationByPosition::FACTS
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let [_, velocity] = written(at);
        velocity
    }

    fn residual<S: Divide>(at: &Written<'_, S>, values: &[S]) -> Vec<S> {
        let form = at.formulation;
        let slopes = form.torque_by_velocity(at.arm, at.at, &at.motion.qd);
        defect(at, values, &slopes)
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        let [_, velocity] = slopes(at);
        Some(velocity)
    }
}

impl Formula for AccelerationByTorque {
    const FACTS: Facts = Facts {
        field: "dqdd_dtau",
        letter: "q̈τ",
        symbol: "∂q̈/∂τ",
        summary: "∂q̈/∂τ = D⁻¹.",
        given: None,
        ..InertiaInverse::FACTS
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        InertiaInverse::written(at)
    }

    fn residual<S: Divide>(at: &Written<'_, S>, values: &[S]) -> Vec<S> {
        InertiaInverse::residual(at, values)
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        InertiaInverse::regrouped(at)
    }
}

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
        arguments: &[Position, Velocity, Acceleration, Multiplier],
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
        arguments: &[Position, Velocity, Multiplier],
        unit: |at| by_turns(turns(at), ["N·s/m", "N·s", "N·m·s"]),
        given: Some("d2tau_dq_dqd"),
        ..Facts::MATRIX
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let (motion, form) = (at.motion, at.formulation);
        let inputs = [&motion.qd[..], &motion.multiplier];
        let rows = form.torque_by_position_and_velocity(at.arm, at.at, inputs);
        rows.concat()
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
        arguments: &[Position, Multiplier],
        given: Some("d2tau_dqdd_dq"),
        ..TorqueByVelocities::FACTS
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let (form, multiplier) = (at.formulation, &at.motion.multiplier);
        let rows = form.torque_by_acceleration_and_position(at.arm, at.at, multiplier);
        rows.concat()
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
    inverse: Matrix<S>,
    raised: Vec<S>,
}

impl<S: Divide> InverseTerms<S> {
    fn new(at: &Written<'_, S>) -> Self {
        let (form, motion) = (at.formulation, at.motion);
        let inverse = form.inertia_inverse(at.arm, at.at, &motion.moves);
        let raised = products(&inverse, &motion.multiplier);
        InverseTerms { inverse, raised }
    }

    fn driven(&self, at: &Written<'_, S>) -> Matrix<S> {
        (at.formulation).torque_by_acceleration_and_position(at.arm, at.at, &self.raised)
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
        arguments: &[Position, Velocity, Torque, Multiplier],
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
        arguments: &[Position, Velocity, Multiplier],
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
        let rows = terms.by_position_and_velocity(&curvatures, &slopes);
        rows.concat()
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
        arguments: &[Position, Multiplier],
        unit: |at| match at {
            [Index::Turning, Index::Turning] => "1/(kg·m²)",
            [Index::Turning, _] => "1/(kg·m³)",
            [_, Index::Turning] => "1/(kg·m)",
            _ => "1/(kg·m²)",
        },
        given: Some("d2qdd_dtau_dq"),
        ..AccelerationByPositionAndVelocity::FACTS
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
