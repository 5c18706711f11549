//! ŵ = (J Jᵀ + λ² 1)⁻¹ J τ: the wrench on the hand that torques of its alone say, such as
//! those that an observer of momentum finds.

use alloc::vec::Vec;

use super::formula::Formula;
use super::function::Definition;
use super::quantity::Facts;
use super::quantity::FrameChoice;
use super::{Argument, Axis, Index, Quantity, Shape, Written};
use crate::equations::contact::squared;
use crate::equations::operational::{damped, products};
use crate::scalar::Divide;

pub(super) const FUNCTION: Definition = Definition {
    name: "contact_wrench",
    summary: "The wrench on the hand that the torques τ come from: ŵ = (J Jᵀ + λ² 1)⁻¹ J τ.",
    results: &[Quantity::ContactWrench],
    ..Definition::PLAIN
};

/// ŵ_r
pub(super) struct ContactWrench;

impl Formula for ContactWrench {
    const FACTS: Facts = Facts {
        field: "contact_wrench",
        letter: "ŵ",
        symbol: "ŵ",
        summary: "Wrench ŵ, force over moment.",
        arguments: &[Argument::Position, Argument::Torque, Argument::Damping],
        shape: Shape(&[Axis::Fixed(6)]),
        unit: |at| match at {
            [Index::Fixed(..3)] => "N",
            _ => "N·m",
        },
        given: Some("contact_wrench"),
        depends_on_base: true,
        frame: FrameChoice::Rows,
        ..Facts::PLAIN
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let motion = at.motion;
        let given = [motion.tau.as_slice(), &motion.damping];
        at.formulation
            .wrench_of_torques(at.arm, at.at, given, &motion.moves)
    }

    fn divisor<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let motion = at.motion;
        let j = at.formulation.moving_jacobian(at.arm, at.at, &motion.moves);
        damped(&squared(&j), &motion.damping[0]).concat()
    }

    /// Returns (J Jᵀ + λ² 1) ŵ − J τ
    fn residual<S: Divide>(at: &Written<'_, S>, wrench: &[S]) -> Vec<S> {
        let motion = at.motion;
        let j = at.formulation.moving_jacobian(at.arm, at.at, &motion.moves);
        let left = products(&damped(&squared(&j), &motion.damping[0]), wrench);
        let right = products(&j, &motion.tau);
        left.iter().zip(&right).map(|(a, b)| a.sub(b)).collect()
    }
}
