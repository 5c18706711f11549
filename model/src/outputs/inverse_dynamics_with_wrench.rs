//! τ = D q̈ + h + c + b∘q̇ − Jᵀw: what the drives give while w acts on the hand.

use alloc::vec::Vec;

use super::formula::Formula;
use super::function::Definition;
use super::inverse_dynamics::torques;
use super::operational_inertia_inverse::OF_HAND;
use super::quantity::{Choice, Facts, FrameChoice, load};
use super::{Argument, ErrorScale, Quantity, Regrouped, Shape, Written};
use crate::equations::chain::HandChoice;
use crate::equations::matrix::minus;
use crate::scalar::{Divide, Scalar};

pub(super) const FUNCTION: Definition = Definition {
    name: "inverse_dynamics_with_wrench",
    summary: "Inverse dynamics while a wrench w acts on the hand: τ = D q̈ + h + c + b∘q̇ - Jᵀw.",
    results: &[Quantity::ContactTorque],
    ..Definition::PLAIN
};

/// τ_i
pub(super) struct ContactTorque;

/// Returns Jᵀ w over all joints of the arm.
pub(super) fn of_wrench<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
    at.formulation
        .torques_of_wrench(at.arm, at.at, &at.motion.wrench)
}

/// Returns a − b
pub(super) fn less<S: Scalar>(a: &[S], b: &[S]) -> Vec<S> {
    a.iter().zip(b).map(|(a, b)| minus(a, b)).collect()
}

impl Formula for ContactTorque {
    const FACTS: Facts = Facts {
        field: "tau",
        letter: "τ",
        symbol: "τ(w)",
        summary: "Torques τ beside the wrench.",
        arguments: &[
            Argument::Position,
            Argument::Velocity,
            Argument::Acceleration,
            Argument::Wrench,
        ],
        shape: Shape::VECTOR,
        unit: load,
        scale: ErrorScale::Load,
        given: Some("tau_with_wrench"),
        choices: Some(&[Choice::Recursion]),
        gravity: true,
        frame: FrameChoice::Axes,
        hand: HandChoice::None,
        ..OF_HAND
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let motion = at.motion;
        let own = at
            .formulation
            .inverse_dynamics(at.arm, at.at, &motion.qd, &motion.qdd);
        less(&own, &of_wrench(at))
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        let wrench = at.pick(&of_wrench(at.textbook.as_ref()?));
        Some(less(&torques(at, &at.motion.qdd), &wrench))
    }
}
