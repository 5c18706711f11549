//! μ = Λ (J D⁻¹ (h + c) − J̇ q̇): the wrench that keeps the hand's velocity while the joints
//! are driven by nothing else. Friction is no part of it.

use alloc::vec::Vec;

use super::formula::Formula;
use super::function::Definition;
use super::inverse_dynamics::torques;
use super::operational_inertia::damped_mobility;
use super::operational_inertia_inverse::{OF_HAND, chain_jacobian, factor, hand};
use super::quantity::{Choice, Facts};
use super::{Argument, Axis, Index, Quantity, Regrouped, Shape, Written};
use crate::equations::following::gathered;
use crate::equations::matrix::zeros;
use crate::equations::operational::{TaskSpace, driven_by};
use crate::scalar::Divide;

pub(super) const FUNCTION: Definition = Definition {
    name: "operational_bias",
    summary: "Bias force of the hand: μ = Λ (J D⁻¹ (h + c) - J̇q̇), without friction.",
    results: &[Quantity::OperationalBias],
    ..Definition::PLAIN
};

/// μ_r
pub(super) struct OperationalBias;

impl Formula for OperationalBias {
    const FACTS: Facts = Facts {
        field: "operational_bias",
        letter: "μ",
        symbol: "μ",
        summary: "Bias force μ of the hand, force over moment.",
        arguments: &[Argument::Position, Argument::Velocity, Argument::Damping],
        shape: Shape(&[Axis::Fixed(6)]),
        unit: |at| match at {
            [Index::Fixed(..3)] => "N",
            _ => "N·m",
        },
        given: Some("operational_bias"),
        choices: Some(&[Choice::Recursion, Choice::Travel]),
        gravity: true,
        ..OF_HAND
    };

    const INVERTS_INERTIA: bool = true;

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let motion = at.motion;
        let damping = &motion.damping[0];
        at.formulation
            .operational_bias(at.arm, at.at, &motion.qd, damping, &motion.moves)
    }

    fn divisor<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        damped_mobility(at).concat()
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        let motion = at.motion;
        let (hand, qd) = (hand(at)?, &at.textbook.as_ref()?.motion.qd);
        let chain = at.chain.clone().without_friction();
        let free = Regrouped {
            chain: &chain,
            ..at.clone()
        };
        let loads = gathered(at.following, torques(&free, &zeros(motion.qd.len())));
        let (jacobian, factor) = (chain_jacobian(at, &hand), factor(at));
        let driven = driven_by(&jacobian, &factor, &loads, &motion.moves);
        let space = TaskSpace::by_factor(jacobian, &factor, &motion.moves);
        let bias = space.bias(&driven, &hand.rate(qd), &motion.damping[0]);
        Some(hand.turned(&[bias]).concat())
    }
}
