//! Torques, accelerations and a wrench that acts on the hand.

use alloc::vec::Vec;

use super::formula::Formula;
use super::forward_dynamics::{Acceleration, accelerations, rest};
use super::operational::{OF_HAND, OperationalBias};
use super::quantity::{Choice, Facts, FrameChoice, load};
use super::torques::torques;
use super::{Argument, Axis, ErrorScale, Motion, Regrouped, Shape, Written};
use crate::equations::chain::{HandChoice, Unknowns};
use crate::equations::contact::squared;
use crate::equations::matrix::{differences, products, sums};
use crate::equations::operational::damped;
use crate::scalar::Divide;

pub(super) struct ContactTorque;

pub(super) fn of_wrench<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
    at.formulation
        .torques_of_wrench(at.arm, at.at, &at.motion.wrench)
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
        inverts_inertia: false,
        gravity: true,
        frame: FrameChoice::Axes,
        hand: HandChoice::None,
        ..OF_HAND
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let (form, motion) = (at.formulation, at.motion);
        let torques = form.inverse_dynamics(at.arm, at.at, &motion.qd, &motion.qdd);
        differences(&torques, &of_wrench(at))
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        let wrench = at.pick(&of_wrench(at.textbook.as_ref()?));
        Some(differences(&torques(at, &at.motion.qdd), &wrench))
    }
}

pub(super) struct ContactAcceleration;

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
        unit: Acceleration::FACTS.unit,
        scale: ErrorScale::None,
        given: Some("qdd_with_wrench"),
        choices: Some(&[Choice::Recursion, Choice::Travel]),
        inverts_inertia: true,
        has_shoulder: true,
        ..ContactTorque::FACTS
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let (form, motion) = (at.formulation, at.motion);
        let tau = sums(&motion.tau, &of_wrench(at));
        form.forward_dynamics(at.arm, at.at, &motion.qd, &tau, &motion.moves)
    }

    fn residual<S: Divide>(at: &Written<'_, S>, qdd: &[S]) -> Vec<S> {
        rest(at, qdd, &sums(&at.motion.tau, &of_wrench(at)))
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        let wrench = at.pick(&of_wrench(at.textbook.as_ref()?));
        let motion = Motion {
            tau: sums(&at.motion.tau, &wrench),
            ..at.motion.clone()
        };
        let at = Regrouped {
            motion: &motion,
            ..at.clone()
        };
        Some(accelerations(&at, Unknowns::AgainstBase))
    }
}

/// The wrench that torques of it alone say, such as those that an observer of momentum finds.
pub(super) struct ContactWrench;

impl Formula for ContactWrench {
    const FACTS: Facts = Facts {
        field: "contact_wrench",
        letter: "ŵ",
        summary: "Wrench ŵ, force over moment.",
        arguments: &[Argument::Position, Argument::Torque, Argument::Damping],
        shape: Shape(&[Axis::Fixed(6)]),
        unit: OperationalBias::FACTS.unit,
        given: Some("contact_wrench"),
        depends_on_base: true,
        frame: FrameChoice::Rows,
        ..Facts::PLAIN
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let (form, motion) = (at.formulation, at.motion);
        let inputs = [motion.tau.as_slice(), &motion.damping];
        form.wrench_of_torques(at.arm, at.at, inputs, &motion.moves)
    }

    fn divisor<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let [_, matrix] = normal(at);
        matrix.concat()
    }

    /// Returns (J Jᵀ + λ² 1) ŵ − J τ
    fn residual<S: Divide>(at: &Written<'_, S>, wrench: &[S]) -> Vec<S> {
        let [j, matrix] = normal(at);
        let (left, right) = (products(&matrix, wrench), products(&j, &at.motion.tau));
        left.iter().zip(&right).map(|(a, b)| a.sub(b)).collect()
    }
}

/// Returns J and J Jᵀ + λ² 1.
fn normal<S: Divide>(at: &Written<'_, S>) -> [Vec<Vec<S>>; 2] {
    let motion = at.motion;
    let j = at.formulation.moving_jacobian(at.arm, at.at, &motion.moves);
    let matrix = damped(&squared(&j), &motion.damping[0]);
    [j, matrix]
}
