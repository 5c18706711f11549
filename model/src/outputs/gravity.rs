//! c, the gravity load (eqs. 2.15, 4.5).

use alloc::vec::Vec;

use super::formula::Formula;
use super::function::Definition;
use super::quantity::{Choice, Facts, load};
use super::{Argument, ErrorScale, PayloadDependence, Quantity, Regrouped, Shape, Written};
use crate::scalar::Divide;

pub(super) const FUNCTION: Definition = Definition {
    name: "gravity",
    summary: "Gravity load c(q): the torques that hold the arm still.",
    results: &[Quantity::Gravity],
    by_default: true,
    ..Definition::PLAIN
};

/// c_i
pub(super) struct Gravity;

impl Formula for Gravity {
    const FACTS: Facts = Facts {
        field: "c",
        letter: "c",
        symbol: "c",
        summary: "Gravity load c.",
        arguments: &[Argument::Position],
        shape: Shape::VECTOR,
        unit: load,
        scale: ErrorScale::Load,
        given: Some("c"),
        choices: Some(&[Choice::Travel]),
        payload_dependence: PayloadDependence::Torque,
        gravity: true,
        ..Facts::PLAIN
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        at.formulation.gravity(at.arm, at.at)
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        Some(at.composite.gravity(at.form.travel))
    }
}
