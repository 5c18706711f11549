//! J̄ = D⁻¹ Jᵀ Λ, the inverse of J that moves the hand with the least kinetic energy.

use alloc::vec::Vec;

use super::formula::Formula;
use super::function::Definition;
use super::operational_inertia::damped_mobility;
use super::operational_inertia_inverse::{OF_HAND, hand, normal, space, written_space};
use super::quantity::Facts;
use super::{Argument, Axis, Index, Quantity, Regrouped, Shape, Written};
use crate::equations::chain::HandChoice;
use crate::scalar::Divide;

pub(super) const FUNCTION: Definition = Definition {
    name: "consistent_inverse",
    summary: "Dynamically consistent inverse of the Jacobian: J̄ = D⁻¹ Jᵀ Λ, n×6.",
    results: &[Quantity::ConsistentInverse],
    ..Definition::PLAIN
};

/// J̄_ir
pub(super) struct ConsistentInverse;

impl Formula for ConsistentInverse {
    const FACTS: Facts = Facts {
        field: "consistent_inverse",
        letter: "J̄",
        symbol: "J̄",
        summary: "Dynamically consistent inverse J̄ of the Jacobian.",
        arguments: &[Argument::Position, Argument::Damping],
        shape: Shape(&[Axis::Joints, Axis::Fixed(6)]),
        unit: |at| match at {
            [Index::Turning, Index::Fixed(..3)] => "1/m",
            [Index::Sliding, Index::Fixed(3..)] => "m",
            _ => "1",
        },
        given: Some("consistent_inverse"),
        hand: HandChoice::Normal,
        ..OF_HAND
    };

    const INVERTS_INERTIA: bool = true;

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let inverse = written_space(at).consistent_inverse(&at.motion.damping[0]);
        inverse.concat()
    }

    fn divisor<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        damped_mobility(at).concat()
    }

    /// Returns D J̄ (Λ⁻¹ + λ² 1) − Jᵀ over the joints that move.
    fn residual<S: Divide>(at: &Written<'_, S>, inverse: &[S]) -> Vec<S> {
        let matrix = damped_mobility(at);
        let d = at.formulation.gathered_inertia(at.arm, at.at);
        let j = at.formulation.gathered_jacobian(at.arm, at.at);
        let (m, moves) = (j.len(), &at.motion.moves);
        let sum = |products: &mut dyn Iterator<Item = S>| {
            products.fold(S::zero(), |sum, product| sum.add(&product))
        };
        // J̄ (Λ⁻¹ + λ² 1)
        let given =
            |i: usize, r: usize| sum(&mut (0..m).map(|s| inverse[i * m + s].mul(&matrix[s][r])));
        let moving = (0..moves.len()).filter(|&i| moves[i]);
        let mut residual = Vec::new();
        for (r, row) in j.iter().enumerate() {
            let column: Vec<S> = (0..moves.len()).map(|k| given(k, r)).collect();
            for i in moving.clone() {
                let left = sum(&mut column.iter().zip(&d[i]).map(|(x, d)| d.mul(x)));
                residual.push(left.sub(&row[i]));
            }
        }
        residual
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        let hand = hand(at)?;
        let inverse = match normal(at, &hand) {
            Some(normal) => normal.consistent_inverse(),
            None => space(at, &hand).consistent_inverse(&at.motion.damping[0]),
        };
        Some(hand.turned(&inverse).concat())
    }
}
