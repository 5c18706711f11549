//! Outputs of kinematics: poses, Jacobians and wrenches between links.

use alloc::vec::Vec;

use super::formula::Formula;
use super::quantity::{Facts, FrameChoice};
use super::{Argument, Axis, Index, PayloadDependence, Shape, Written};
use crate::equations::kinematics::link_poses;
use crate::equations::matrix::Columns;
use crate::scalar::Divide;

/// [R | p] of ⁰A_n (eq. 2.1)
pub(super) struct Pose;
impl Formula for Pose {
    const FACTS: Facts = Facts {
        field: "pose",
        letter: "A",
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

/// [R_i | p_i] of ⁰A_i (eq. 2.1)
pub(super) struct LinkPoses;
impl Formula for LinkPoses {
    const FACTS: Facts = Facts {
        field: "poses",
        letter: "A",
        symbol: "A_i",
        summary: "Poses [R | p] of the links' frames.",
        arguments: &[Argument::Position],
        shape: Shape(&[Axis::Links, Axis::Fixed(3), Axis::Fixed(4)]),
        unit: Pose::FACTS.unit,
        depends_on_base: true,
        of_links: true,
        ..Facts::PLAIN
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let poses = link_poses(at.arm, at.at);
        poses.iter().flat_map(Columns::rows).collect()
    }
}

pub(super) struct Jacobian;
impl Formula for Jacobian {
    const FACTS: Facts = Facts {
        field: "jacobian",
        letter: "J",
        summary: "Jacobian J, linear over angular.",
        shape: Shape(&[Axis::Fixed(6), Axis::Coordinates]),
        unit: |at| match at {
            [Index::Fixed(..3), Index::Turning] => "m",
            [Index::Fixed(3..), Index::Sliding] => "1/m",
            _ => "1",
        },
        given: Some("jacobian"),
        frame: FrameChoice::Rows,
        ..Pose::FACTS
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        at.formulation.task_jacobian(at.arm, at.at).concat()
    }
}

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
        ..Jacobian::FACTS
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let rate = at.formulation.jacobian_rate(at.arm, at.at, &at.motion.qd);
        at.arm.frames.rows.pick(&rate.concat())
    }
}

/// (f_i, n_i) (Table 1)
pub(super) struct Wrench;
impl Formula for Wrench {
    const FACTS: Facts = Facts {
        field: "wrenches",
        letter: "w",
        summary: "Force over moment at every joint in base axes, about the origin of the link's frame; of a DH row about that of the frame whose z is the axis.",
        arguments: &Argument::STATE,
        shape: Shape(&[Axis::Links, Axis::Fixed(6)]),
        unit: |at| match at {
            [_, Index::Fixed(..3)] => "N",
            _ => "N·m",
        },
        given: Some("wrench"),
        depends_on_base: true,
        payload_dependence: PayloadDependence::Full,
        gravity: true,
        of_links: true,
        ..Facts::PLAIN
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let (form, motion) = (at.formulation, at.motion);
        let wrenches = form.reactions(at.arm, at.at, [&motion.qd, &motion.qdd]);
        let numbers = wrenches.into_iter().flat_map(|w| [w.force, w.moment]);
        numbers.flatten().collect()
    }
}
