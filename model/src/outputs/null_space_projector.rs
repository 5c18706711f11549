//! N = 1 − J̄ J: the part of a motion of the joints that the hand does not feel. Torques
//! through Nᵀ do not accelerate it.

use alloc::vec::Vec;

use super::formula::Formula;
use super::function::Definition;
use super::operational_inertia::damped_mobility;
use super::operational_inertia_inverse::{OF_HAND, hand, normal, space, written_space};
use super::quantity::Facts;
use super::{Argument, Index, Quantity, Regrouped, Shape, Written};
use crate::equations::chain::HandChoice;
use crate::scalar::Divide;

pub(super) const FUNCTION: Definition = Definition {
    name: "null_space_projector",
    summary: "Null-space projector N = 1 - J̄ J of velocities; Nᵀ is that of torques.",
    results: &[Quantity::NullSpace],
    ..Definition::PLAIN
};

/// N_ik
pub(super) struct NullSpace;

impl Formula for NullSpace {
    const FACTS: Facts = Facts {
        field: "null_space",
        letter: "N",
        symbol: "N",
        summary: "Null-space projector N = 1 - J̄ J.",
        arguments: &[Argument::Position, Argument::Damping],
        shape: Shape::MATRIX,
        unit: |at| match at {
            [Index::Turning, Index::Sliding] => "1/m",
            [Index::Sliding, Index::Turning] => "m",
            _ => "1",
        },
        given: Some("null_space_projector"),
        hand: HandChoice::Normal,
        ..OF_HAND
    };

    const INVERTS_INERTIA: bool = true;

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let motion = at.motion;
        let projector = written_space(at).null_space(&motion.damping[0], &motion.moves);
        projector.concat()
    }

    fn divisor<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        damped_mobility(at).concat()
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        let motion = at.motion;
        let hand = hand(at)?;
        let projector = match normal(at, &hand) {
            Some(normal) => normal.null_space(),
            None => space(at, &hand).null_space(&motion.damping[0], &motion.moves),
        };
        Some(projector.concat())
    }
}
