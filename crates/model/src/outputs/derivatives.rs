//! First derivatives of torques and accelerations.
//!
//! With q̈ in the place of the free argument, D q̈ + h + c + b∘q̇ = τ holds for
//! all q and q̇, so that D ∂q̈/∂q = −∂τ/∂q at that q̈, and likewise for q̇.

use alloc::vec::Vec;

use super::formula::Formula;
use super::forward_dynamics::{InertiaInverse, accelerations, inverse};
use super::quantity::{Facts, Index, by_turns, turns};
use super::{Argument, Regrouped, Written};
use crate::equations::chain::Unknowns;
use crate::equations::following::{gathered_columns, spread};
use crate::equations::forward::{against, free};
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
        arguments: &[Argument::Position, Argument::Velocity],
        unit: |at| by_turns(turns(at), ["N·s/m", "N·s", "N·m·s"]),
        given: Some("dtau_dqd"),
        ..Facts::MATRIX
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let form = at.formulation;
        form.torque_by_velocity(at.arm, at.at, &at.motion.qd)
            .concat()
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
        arguments: &[Argument::Position, Argument::Velocity, Argument::Torque],
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
