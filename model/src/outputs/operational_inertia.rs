//! Λ = (J D⁻¹ Jᵀ + λ² 1)⁻¹, the inertia of the hand.

use alloc::vec::Vec;

use super::formula::Formula;
use super::function::Definition;
use super::operational_inertia_inverse::{OF_HAND, angular, hand, space, written_space};
use super::quantity::Facts;
use super::{Argument, Axis, Quantity, Regrouped, Shape, Written};
use crate::scalar::Divide;

pub(super) const FUNCTION: Definition = Definition {
    name: "operational_inertia",
    summary: "Inertia of the hand, damped where the arm is singular: Λ = (J D⁻¹ Jᵀ + λ² 1)⁻¹, symmetric.",
    results: &[Quantity::OperationalInertia],
    ..Definition::PLAIN
};

/// Λ_rs
pub(super) struct OperationalInertia;

/// Returns Λ⁻¹ + λ² 1, which all that has Λ divides by.
pub(super) fn damped_mobility<S: Divide>(at: &Written<'_, S>) -> Vec<Vec<S>> {
    written_space(at).damped(&at.motion.damping[0])
}

impl Formula for OperationalInertia {
    const FACTS: Facts = Facts {
        field: "operational_inertia",
        letter: "Λ",
        symbol: "Λ",
        summary: "Inertia Λ of the hand, linear over angular.",
        arguments: &[Argument::Position, Argument::Damping],
        shape: Shape(&[Axis::Fixed(6), Axis::Fixed(6)]),
        unit: |at| match angular(at) {
            0 => "kg",
            1 => "kg·m",
            _ => "kg·m²",
        },
        given: Some("operational_inertia"),
        ..OF_HAND
    };

    const INVERTS_INERTIA: bool = true;

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        written_space(at).inertia(&at.motion.damping[0]).concat()
    }

    fn divisor<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        damped_mobility(at).concat()
    }

    /// Returns (Λ⁻¹ + λ² 1) Λ − 1
    fn residual<S: Divide>(at: &Written<'_, S>, inertia: &[S]) -> Vec<S> {
        let matrix = damped_mobility(at);
        let m = matrix.len();
        let entry = |i: usize, k: usize| {
            let one = if i == k { S::one() } else { S::zero() };
            let products = (0..m).map(|j| matrix[i][j].mul(&inertia[j * m + k]));
            products.fold(one.neg(), |sum, product| sum.add(&product))
        };
        let rows = (0..m).flat_map(|i| (0..m).map(move |k| (i, k)));
        rows.map(|(i, k)| entry(i, k)).collect()
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        let hand = hand(at)?;
        let inertia = space(at, &hand).inertia(&at.motion.damping[0]);
        Some(hand.turned_matrix(&inertia).concat())
    }
}
