//! D, every Christoffel symbol h_ikm and c in one function.

use alloc::vec::Vec;

use super::formula::Formula;
use super::function::Definition;
use super::quantity::{Facts, kilograms, turns};
use super::{Argument, ErrorScale, PayloadDependence, Quantity, Regrouped, Shape, Written};
use crate::scalar::Divide;

pub(super) const FUNCTION: Definition = Definition {
    name: "dynamic_coefficients",
    summary: "D(q), every Christoffel symbol h_ikm(q) and c(q), with shared work.",
    results: &[Quantity::Inertia, Quantity::Christoffel, Quantity::Gravity],
    structure: Some("DynamicCoefficients"),
    ..Definition::PLAIN
};

/// h_ikm
pub(super) struct Christoffel;

impl Formula for Christoffel {
    const FACTS: Facts = Facts {
        field: "h",
        letter: "h",
        symbol: "h_ikm",
        summary: "`h[i][k][m]` = h_ikm, zero-based, symmetric in k and m.",
        arguments: &[Argument::Position],
        shape: Shape::CUBE,
        // Twice per metre where both rates are of length, the force once.
        unit: |at| kilograms(turns(at) - 1),
        scale: ErrorScale::Coefficient,
        given_as: Some((Quantity::Coriolis, contract)),
        choices: Some(&[]),
        by_differences: true,
        payload_dependence: PayloadDependence::Torque,
        ..Facts::PLAIN
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let h = at.formulation.christoffel(at.arm, at.at);
        h.into_iter().flatten().flatten().collect()
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        let h = at.composite.christoffel();
        Some(h.into_iter().flatten().flatten().collect())
    }
}

/// Returns h_i = Σ_k Σ_m h_ikm q̇_k q̇_m.
fn contract(symbols: &[f64], qd: &[f64]) -> Vec<f64> {
    let n = qd.len();
    let row = |row: &[f64]| row.iter().zip(qd).map(|(h, v)| h * v).sum::<f64>();
    let load = |matrix: &[f64]| {
        let rows = matrix.chunks(n.max(1));
        rows.zip(qd).map(|(r, v)| row(r) * v).sum::<f64>()
    };
    symbols.chunks((n * n).max(1)).map(load).collect()
}
