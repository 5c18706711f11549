//! q̈ = D⁻¹ (τ + Jᵀw − h − c − b∘q̇): how the arm moves while w acts on its hand.

use alloc::vec::Vec;

use super::formula::Formula;
use super::forward_dynamics::{accelerations, rest};
use super::function::Definition;
use super::inverse_dynamics_with_wrench::of_wrench;
use super::operational_inertia_inverse::OF_HAND;
use super::quantity::{Choice, Facts, FrameChoice, turns};
use super::{Argument, Motion, Quantity, Regrouped, Shape, Written};
use crate::equations::chain::HandChoice;
use crate::equations::chain::Unknowns;
use crate::equations::matrix::plus;
use crate::scalar::{Divide, Scalar};

pub(super) const FUNCTION: Definition = Definition {
    name: "forward_dynamics_with_wrench",
    summary: "Forward dynamics while a wrench w acts on the hand: q̈ = D⁻¹ (τ + Jᵀw - h - c - b∘q̇).",
    results: &[Quantity::ContactAcceleration],
    ..Definition::PLAIN
};

/// q̈_i
pub(super) struct ContactAcceleration;

/// Returns a + b
fn added<S: Scalar>(a: &[S], b: &[S]) -> Vec<S> {
    a.iter().zip(b).map(|(a, b)| plus(a, b)).collect()
}

impl Formula for ContactAcceleration {
    const FACTS: Facts = Facts {
        field: "qdd",
        letter: "q̈",
        symbol: "q̈(w)",
        summary: "Accelerations q̈ under the wrench.",
        arguments: &[
            Argument::Position,
            Argument::Velocity,
            Argument::Torque,
            Argument::Wrench,
        ],
        shape: Shape::VECTOR,
        unit: |at| match turns(at) {
            0 => "m/s²",
            _ => "rad/s²",
        },
        given: Some("qdd_with_wrench"),
        choices: Some(&[Choice::Recursion, Choice::Travel]),
        gravity: true,
        has_shoulder: true,
        frame: FrameChoice::Axes,
        hand: HandChoice::None,
        ..OF_HAND
    };

    const INVERTS_INERTIA: bool = true;

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let motion = at.motion;
        let tau = added(&motion.tau, &of_wrench(at));
        at.formulation
            .forward_dynamics(at.arm, at.at, &motion.qd, &tau, &motion.moves)
    }

    /// Returns inverse dynamics of the motion less τ and Jᵀw, of the joints that move.
    fn residual<S: Divide>(at: &Written<'_, S>, qdd: &[S]) -> Vec<S> {
        rest(at, qdd, &added(&at.motion.tau, &of_wrench(at)))
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        let wrench = at.pick(&of_wrench(at.textbook.as_ref()?));
        let motion = Motion {
            tau: added(&at.motion.tau, &wrench),
            ..at.motion.clone()
        };
        let at = Regrouped {
            motion: &motion,
            ..at.clone()
        };
        Some(accelerations(&at, Unknowns::AgainstBase))
    }
}
