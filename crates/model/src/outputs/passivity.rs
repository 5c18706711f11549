//! The Coriolis matrix, and the torques of controllers that use it.

use alloc::vec::Vec;

use super::formula::Formula;
use super::quantity::{Choice, Facts, by_turns, load, turns};
use super::{Argument, ErrorScale, PayloadDependence, Regrouped, Shape, Written};
use crate::equations::energy::contracted;
use crate::scalar::Divide;

/// C_ik = Σ_m h_ikm q̇_m
pub(super) struct CoriolisMatrix;

impl Formula for CoriolisMatrix {
    const FACTS: Facts = Facts {
        field: "c_matrix",
        letter: "C",
        summary: "Coriolis matrix C.",
        arguments: &[Argument::Position, Argument::Velocity],
        shape: Shape::MATRIX,
        unit: |at| by_turns(turns(at), ["N·s/m", "N·s", "N·m·s"]),
        choices: Some(&[Choice::Flows]),
        by_differences: true,
        payload_dependence: PayloadDependence::Torque,
        ..Facts::PLAIN
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let c = at.formulation.coriolis_matrix(at.arm, at.at, &at.motion.qd);
        c.concat()
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        let qd = &at.motion.qd;
        let c = match at.form.flows {
            true => at.composite.coriolis_matrix(qd, at.form.travel),
            false => contracted(&at.composite.christoffel(), qd),
        };
        Some(c.concat())
    }
}

pub(super) const ARGUMENTS: &[Argument] = &[
    Argument::Position,
    Argument::Velocity,
    Argument::ReferenceVelocity,
    Argument::ReferenceAcceleration,
];

/// (D a + C v + c + b∘v)_i: what passivity-based controllers (Slotine and Li) ask of a model,
/// with v and a the velocity and the acceleration wished for.
pub(super) struct Passivity;

impl Formula for Passivity {
    const FACTS: Facts = Facts {
        field: "tau",
        letter: "τ",
        symbol: "D a + C v + c + b∘v",
        summary: "Torques D a + C v + c + b∘v.",
        arguments: ARGUMENTS,
        shape: Shape::VECTOR,
        unit: load,
        scale: ErrorScale::Load,
        choices: Some(&[]),
        by_differences: true,
        payload_dependence: PayloadDependence::Torque,
        gravity: true,
        ..Facts::PLAIN
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let motion = at.motion;
        let wished = [&motion.v[..], &motion.a[..]];
        at.formulation.passivity(at.arm, at.at, &motion.qd, wished)
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        let motion = at.motion;
        Some(at.chain.passivity(at.at, &motion.qd, &motion.v, &motion.a))
    }
}
