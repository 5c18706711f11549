//! ⁰A_n, the pose of the hand (eq. 2.1).

use alloc::vec::Vec;

use super::formula::Formula;
use super::function::Definition;
use super::quantity::Facts;
use super::quantity::FrameChoice;
use super::{Argument, Axis, Index, Quantity, Shape, Written};
use crate::scalar::Divide;

pub(super) const FUNCTION: Definition = Definition {
    name: "forward_kinematics",
    summary: "Forward kinematics: the pose [R | p] of the last frame in base axes, 3×4, lengths in metres.",
    results: &[Quantity::Pose],
    by_default: true,
    ..Definition::PLAIN
};

/// [R | p]
pub(super) struct Pose;

impl Formula for Pose {
    const FACTS: Facts = Facts {
        field: "pose",
        letter: "A",
        symbol: "A",
        summary: "Pose [R | p] of the last frame.",
        arguments: &[Argument::Position],
        shape: Shape(&[Axis::Fixed(3), Axis::Fixed(4)]),
        unit: |at| match at {
            [.., Index::Fixed(3)] => "m",
            _ => "1",
        },
        given: Some("pose"),
        depends_on_base: true,
        frame: FrameChoice::Frame,
        ..Facts::PLAIN
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        at.formulation.hand(at.arm, at.at).rows()
    }
}
