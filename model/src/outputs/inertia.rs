//! D, the inertia matrix (eqs. 2.13, 4.2).

use alloc::vec::Vec;

use super::formula::Formula;
use super::function::Definition;
use super::quantity::{Choice, Facts, kilograms, turns};
use super::{Argument, ErrorScale, PayloadDependence, Quantity, Regrouped, Shape, Written};
use crate::scalar::Divide;

pub(super) const FUNCTION: Definition = Definition {
    name: "inertia",
    summary: "Inertia matrix D(q), symmetric; armature is on its diagonal.",
    results: &[Quantity::Inertia],
    by_default: true,
    ..Definition::PLAIN
};

/// D_ik
pub(super) struct Inertia;

impl Formula for Inertia {
    const FACTS: Facts = Facts {
        field: "d",
        letter: "D",
        symbol: "D",
        summary: "Inertia matrix D.",
        arguments: &[Argument::Position],
        shape: Shape::MATRIX,
        unit: |at| kilograms(turns(at)),
        scale: ErrorScale::Inertia,
        given: Some("D"),
        choices: Some(&[Choice::Travel]),
        definite: true,
        payload_dependence: PayloadDependence::Torque,
        ..Facts::PLAIN
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let d = at.formulation.inertia(at.arm, at.at);
        d.into_iter().flatten().collect()
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        let d = at.composite.inertia(at.form.travel);
        Some(d.into_iter().flatten().collect())
    }
}
