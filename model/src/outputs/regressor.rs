//! Y over the base parameters: τ = Y π with as few columns as there can be.

use alloc::vec::Vec;

use super::formula::Formula;
use super::function::Definition;
use super::quantity::{Choice, Facts};
use super::{Argument, Axis, Index, Quantity, Regrouped, Shape, Written};
use crate::scalar::Divide;

pub(super) const FUNCTION: Definition = Definition {
    name: "regressor",
    summary: "Regressor Y(q, q̇, q̈) over the base parameters, n×k: the joint torques (forces) are τ = Y π.",
    results: &[Quantity::BaseRegressor],
    ..Definition::PLAIN
};

/// Y_ik
pub(super) struct BaseRegressor;

impl Formula for BaseRegressor {
    const FACTS: Facts = Facts {
        field: "y",
        letter: "Y",
        symbol: "Y",
        summary: "Regressor Y over the base parameters.",
        arguments: &Argument::STATE,
        shape: Shape(&[Axis::Joints, Axis::BaseParameters]),
        linear: Some(("τ", "BASE_PARAMETERS")),
        unit: |_| "",
        choices: Some(&[Choice::Travel]),
        // What it shares with what the chain formulas give saves a few.
        starts_from_recursion: true,
        gravity: true,
        ..Facts::PLAIN
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        written(at)
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        Some(regrouped(at))
    }
}

/// Returns the columns by a textbook formulation.
pub(super) fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
    let (motion, formulation) = (at.motion, at.formulation);
    let rows = formulation.regressor(at.arm, at.at, &motion.qd, &motion.qdd, at.columns);
    rows.into_iter().flatten().collect()
}

/// Returns the columns by the chain formulas.
pub(super) fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Vec<S> {
    let (motion, travel) = (at.motion, at.form.travel);
    let rows = at.chain.regressor(at.at, &motion.qd, &motion.qdd, travel);
    rows.into_iter().flatten().collect()
}

/// Returns the unit of an entry: of a torque over that of its parameter.
pub(super) fn unit(at: &[Index]) -> &'static str {
    use crate::equations::regressor::LinkParameter;
    let metres = match at {
        [_, Index::Parameter(LinkParameter::Mass)] => 1,
        [_, Index::Parameter(LinkParameter::First(_))] => 0,
        [_, Index::Parameter(LinkParameter::Tensor(..))] => -1,
        _ => return "",
    };
    match metres + super::quantity::turns(at) {
        2 => "m²/s²",
        1 => "m/s²",
        0 => "1/s²",
        _ => "1/(m·s²)",
    }
}
