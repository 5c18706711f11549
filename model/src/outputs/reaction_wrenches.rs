//! f_i and n_i, what the links exert on each other (Table 1).

use alloc::vec::Vec;

use super::formula::Formula;
use super::function::Definition;
use super::quantity::Facts;
use super::{Argument, Axis, Index, PayloadDependence, Quantity, Shape, Written};
use crate::equations::newton_euler::Wrench as ForceAndMoment;
use crate::scalar::Divide;

pub(super) const FUNCTION: Definition = Definition {
    name: "reaction_wrenches",
    summary: "Force and moment that link i-1 exerts on link i in base axes, gravity included, n×6: for bearings and links.",
    results: &[Quantity::Wrench],
    ..Definition::PLAIN
};

/// (f_i, n_i)
pub(super) struct Wrench;

impl Formula for Wrench {
    const FACTS: Facts = Facts {
        field: "wrenches",
        letter: "w",
        symbol: "w",
        summary: "Force over moment at every joint, about the origin of the frame whose z is its axis.",
        arguments: &Argument::STATE,
        shape: Shape(&[Axis::Joints, Axis::Fixed(6)]),
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
        let motion = at.motion;
        let wrenches = at
            .formulation
            .wrenches(at.arm, at.at, &motion.qd, &motion.qdd);
        flat(wrenches)
    }
}

fn flat<S>(wrenches: Vec<ForceAndMoment<S>>) -> Vec<S> {
    let numbers = wrenches.into_iter().flat_map(|w| [w.force, w.moment]);
    numbers.flatten().collect()
}
