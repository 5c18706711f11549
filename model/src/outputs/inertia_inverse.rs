//! D⁻¹, the inverse of the inertia matrix.

use alloc::vec::Vec;

use super::formula::Formula;
use super::function::Definition;
use super::quantity::{Choice, Facts, turns};
use super::{Argument, PayloadDependence, Quantity, Regrouped, Shape, Written};
use crate::equations::chain::EliminatedTip;
use crate::equations::forward::{free, inverted};
use crate::scalar::Divide;

pub(super) const FUNCTION: Definition = Definition {
    name: "inertia_inverse",
    summary: "Inverse D⁻¹(q) of the inertia matrix, symmetric.",
    results: &[Quantity::InertiaInverse],
    ..Definition::PLAIN
};

/// (D⁻¹)_ik
pub(super) struct InertiaInverse;

/// Returns D⁻¹ of a chain: a last joint that nothing depends on first, D of the others.
pub(super) fn inverse<S: Divide>(at: &Regrouped<'_, S>) -> Vec<Vec<S>> {
    let (moves, travel) = (&at.motion.moves, at.form.travel);
    match EliminatedTip::new(&at.composite, moves).filter(|_| at.following.is_empty()) {
        Some(unspun) => unspun.inertia_inverse(moves, travel),
        None => inverted(&at.gathered_inertia(), moves),
    }
}

impl Formula for InertiaInverse {
    const FACTS: Facts = Facts {
        field: "d_inv",
        letter: "D⁻¹",
        symbol: "D⁻¹",
        summary: "Inverse D⁻¹ of the inertia matrix.",
        arguments: &[Argument::Position],
        shape: Shape::MATRIX,
        unit: |at| match turns(at) {
            0 => "1/kg",
            1 => "1/(kg·m)",
            _ => "1/(kg·m²)",
        },
        given: Some("inertia_inverse"),
        choices: Some(&[Choice::Travel]),
        payload_dependence: PayloadDependence::Torque,
        ..Facts::PLAIN
    };

    const INVERTS_INERTIA: bool = true;

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let inverse = at
            .formulation
            .inertia_inverse(at.arm, at.at, &at.motion.moves);
        inverse.into_iter().flatten().collect()
    }

    /// Returns D D⁻¹ − 1 over the joints that move.
    fn residual<S: Divide>(at: &Written<'_, S>, inverse: &[S]) -> Vec<S> {
        let d = at.formulation.gathered_inertia(at.arm, at.at);
        let (free, n) = (free(&at.motion.moves), d.len());
        let entry = |i: usize, k: usize| {
            let one = if i == k { S::one() } else { S::zero() };
            let products = free.iter().map(|&j| d[i][j].mul(&inverse[j * n + k]));
            products.fold(one.neg(), |sum, product| sum.add(&product))
        };
        let rows = free.iter();
        rows.flat_map(|&i| free.iter().map(move |&k| (i, k)))
            .map(|(i, k)| entry(i, k))
            .collect()
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        Some(inverse(at).into_iter().flatten().collect())
    }
}
