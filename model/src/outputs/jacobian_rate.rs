//! J̇ q̇, what the hand is accelerated by without q̈.

use alloc::vec::Vec;

use super::formula::Formula;
use super::function::Definition;
use super::quantity::Facts;
use super::quantity::FrameChoice;
use super::{Argument, Axis, Index, Quantity, Shape, Written};
use crate::scalar::Divide;

pub(super) const FUNCTION: Definition = Definition {
    name: "jacobian_rate",
    summary: "J̇q̇, the acceleration of the last frame that its velocities alone give, linear over angular.",
    results: &[Quantity::JacobianRate],
    ..Definition::PLAIN
};

/// (J̇ q̇)_r
pub(super) struct JacobianRate;

impl Formula for JacobianRate {
    const FACTS: Facts = Facts {
        field: "jacobian_rate",
        letter: "a",
        symbol: "J̇q̇",
        summary: "J̇q̇, linear over angular.",
        arguments: &[Argument::Position, Argument::Velocity],
        shape: Shape(&[Axis::Fixed(6)]),
        unit: |at| match at {
            [Index::Fixed(..3)] => "m/s²",
            _ => "1/s²",
        },
        given: Some("jacobian_rate_qd"),
        depends_on_base: true,
        frame: FrameChoice::Rows,
        ..Facts::PLAIN
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let rate = at.formulation.jacobian_rate(at.arm, at.at, &at.motion.qd);
        at.arm.frames.rows.pick(&rate.concat())
    }
}
