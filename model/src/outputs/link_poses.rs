//! ⁰A_i, the pose of every link (eq. 2.1).

use alloc::vec::Vec;

use super::formula::Formula;
use super::function::Definition;
use super::quantity::Facts;
use super::{Argument, Axis, Index, Quantity, Shape, Written};
use crate::equations::kinematics::link_poses;
use crate::equations::matrix::Columns;
use crate::scalar::Divide;

pub(super) const FUNCTION: Definition = Definition {
    name: "link_poses",
    summary: "Poses [R | p] of every link's frame in base axes, n×3×4, lengths in metres.",
    results: &[Quantity::LinkPoses],
    ..Definition::PLAIN
};

/// [R_i | p_i]
pub(super) struct LinkPoses;

impl Formula for LinkPoses {
    const FACTS: Facts = Facts {
        field: "poses",
        letter: "A",
        symbol: "A_i",
        summary: "Poses [R | p] of the links' frames.",
        arguments: &[Argument::Position],
        shape: Shape(&[Axis::Joints, Axis::Fixed(3), Axis::Fixed(4)]),
        unit: |at| match at {
            [.., Index::Fixed(3)] => "m",
            _ => "1",
        },
        depends_on_base: true,
        of_links: true,
        ..Facts::PLAIN
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let poses = link_poses(at.arm, at.at);
        poses.iter().flat_map(Columns::rows).collect()
    }
}
