//! J, the Jacobian of the hand.

use alloc::vec::Vec;

use super::formula::Formula;
use super::function::Definition;
use super::quantity::Facts;
use super::quantity::FrameChoice;
use super::{Argument, Axis, Index, Quantity, Shape, Written};
use crate::scalar::Divide;

pub(super) const FUNCTION: Definition = Definition {
    name: "jacobian",
    summary: "Jacobian J(q) of the last frame in base axes, 6×n: linear over angular velocity, at its origin.",
    results: &[Quantity::Jacobian],
    by_default: true,
    ..Definition::PLAIN
};

/// J_rk
pub(super) struct Jacobian;

impl Formula for Jacobian {
    const FACTS: Facts = Facts {
        field: "jacobian",
        letter: "J",
        symbol: "J",
        summary: "Jacobian J, linear over angular.",
        arguments: &[Argument::Position],
        shape: Shape(&[Axis::Fixed(6), Axis::Joints]),
        unit: |at| match at {
            [Index::Fixed(..3), Index::Turning] => "m",
            [Index::Fixed(3..), Index::Sliding] => "1/m",
            _ => "1",
        },
        given: Some("jacobian"),
        depends_on_base: true,
        frame: FrameChoice::Rows,
        ..Facts::PLAIN
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let j = at.formulation.task_jacobian(at.arm, at.at);
        j.into_iter().flatten().collect()
    }
}
