//! Y over every inertial parameter of every link, dependent or not.

use alloc::vec::Vec;

use super::formula::Formula;
use super::function::Definition;
use super::quantity::{Choice, Facts};
use super::regressor::{regrouped, unit, written};
use super::{Argument, Axis, Quantity, Regrouped, Shape, Written};
use crate::scalar::Divide;

pub(super) const FUNCTION: Definition = Definition {
    name: "full_regressor",
    summary: "Regressor Y(q, q̇, q̈) over all links' parameters, n×10n: the links' part of the joint torques is Y π. A link has m, m x, m y, m z, Ixx, Iyy, Izz, Ixy, Iyz, Ixz, about the origin of its DH frame.",
    results: &[Quantity::LinkRegressor],
    ..Definition::PLAIN
};

/// Y_ik
pub(super) struct LinkRegressor;

impl Formula for LinkRegressor {
    const FACTS: Facts = Facts {
        field: "y",
        letter: "Y",
        symbol: "Y over all links' parameters",
        summary: "Regressor Y over all links' parameters.",
        arguments: &Argument::STATE,
        shape: Shape(&[Axis::Joints, Axis::LinkParameters]),
        unit,
        given: Some("regressor"),
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
