//! q̈ = D⁻¹ (τ − h − c − b∘q̇): how the arm moves under given torques.

use alloc::vec::Vec;

use super::formula::Formula;
use super::function::Definition;
use super::inverse_dynamics::torques;
use super::inverse_dynamics_with_wrench::less;
use super::quantity::{Choice, Facts, turns};
use super::{Argument, PayloadDependence, Quantity, Regrouped, Shape, Written};
use crate::equations::chain::{EliminatedTip, Unknowns};
use crate::equations::following::{gathered, spread};
use crate::equations::forward::solved;
use crate::equations::matrix::zeros;
use crate::scalar::Divide;

pub(super) const FUNCTION: Definition = Definition {
    name: "forward_dynamics",
    summary: "Forward dynamics: the accelerations q̈ = D⁻¹ (τ - h - c - b∘q̇).",
    results: &[Quantity::Acceleration],
    by_default: true,
    ..Definition::PLAIN
};

/// q̈_i
pub(super) struct Acceleration;

/// Returns q̈ of a chain: a last joint that nothing depends on first, D of the others.
pub(super) fn accelerations<S: Divide>(at: &Regrouped<'_, S>, unknowns: Unknowns) -> Vec<S> {
    let motion = at.motion;
    if !at.following.is_empty() {
        let bias = torques(at, &zeros(motion.qd.len()));
        let [bias, tau] = [bias, motion.tau.clone()].map(|loads| gathered(at.following, loads));
        return solved(&at.gathered_inertia(), &bias, &tau, &motion.moves);
    }
    if let Some(unspun) = EliminatedTip::new(&at.composite, &motion.moves) {
        let given = [motion.qd.as_slice(), &motion.tau];
        return unspun.forward_dynamics(given, &motion.moves, at.form, unknowns);
    }
    let given = [motion.qd.as_slice(), &motion.tau];
    let by_shoulder = (at.composite).forward_dynamics_by_shoulder(given, &motion.moves, at.form);
    if let Some(accelerations) = by_shoulder {
        return accelerations;
    }
    let d = at.composite.inertia(at.form.travel);
    if !at.form.composite_h {
        let chain = (at.at, d.as_slice());
        return (at.chain).forward_dynamics(chain, given, &motion.moves, at.form, unknowns);
    }
    let bias = torques(at, &zeros(motion.qd.len()));
    at.chain
        .accelerations(&d, [&bias, &motion.tau], &motion.moves, unknowns)
}

/// Returns inverse dynamics of a motion less τ, of the joints that move by themselves.
pub(super) fn rest<S: Divide>(at: &Written<'_, S>, qdd: &[S], tau: &[S]) -> Vec<S> {
    let (form, motion) = (at.formulation, at.motion);
    let qdd = spread(&at.arm.following, qdd.to_vec());
    let taken = form.inverse_dynamics(at.arm, at.at, &motion.qd, &qdd);
    let rest = gathered(&at.arm.following, less(&taken, tau));
    let rest = rest.into_iter().zip(&motion.moves);
    let moving = rest.filter(|(_, moves)| **moves);
    moving.map(|(rest, _)| rest).collect()
}

impl Formula for Acceleration {
    const FACTS: Facts = Facts {
        field: "qdd",
        letter: "q̈",
        symbol: "q̈",
        summary: "Accelerations q̈.",
        arguments: &[Argument::Position, Argument::Velocity, Argument::Torque],
        shape: Shape::VECTOR,
        unit: |at| match turns(at) {
            0 => "m/s²",
            _ => "rad/s²",
        },
        given: Some("forward_dynamics"),
        choices: Some(&[Choice::Recursion, Choice::Travel]),
        payload_dependence: PayloadDependence::Torque,
        gravity: true,
        has_shoulder: true,
        ..Facts::PLAIN
    };

    const INVERTS_INERTIA: bool = true;

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let motion = at.motion;
        at.formulation
            .forward_dynamics(at.arm, at.at, &motion.qd, &motion.tau, &motion.moves)
    }

    /// Returns inverse dynamics of the motion less τ, of the joints that move.
    fn residual<S: Divide>(at: &Written<'_, S>, qdd: &[S]) -> Vec<S> {
        rest(at, qdd, &at.motion.tau)
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        Some(accelerations(at, Unknowns::AgainstBase))
    }
}
