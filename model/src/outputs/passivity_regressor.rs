//! Y over the base parameters in D a + C v + c + b∘v = Y π: what adaptive control
//! (Slotine and Li) multiplies its estimate by.
//!
//! It is not the regressor of the torques at other arguments: C(q, q̇) v has two
//! velocities. For the law that adapts the estimate, Y must be of that very form, with
//! C of the Christoffel symbols: Ḋ − 2C is skew then, and so the energy of the error
//! falls whatever the estimate is.

use alloc::vec::Vec;

use super::formula::Formula;
use super::function::Definition;
use super::passivity::ARGUMENTS;
use super::quantity::{Choice, Facts};
use super::{Axis, Quantity, Regrouped, Shape, Written};
use crate::scalar::Divide;

pub(super) const FUNCTION: Definition = Definition {
    name: "passivity_regressor",
    summary: "Regressor Y(q, q̇, v, a) of passivity-based control over the base parameters, n×k: D a + C v + c + b∘v = Y π, with C of the Christoffel symbols.",
    results: &[Quantity::PassivityRegressor],
    ..Definition::PLAIN
};

/// Y_ik
pub(super) struct PassivityRegressor;

impl Formula for PassivityRegressor {
    const FACTS: Facts = Facts {
        field: "y",
        letter: "Y",
        symbol: "Y of D a + C v + c + b∘v",
        summary: "Regressor Y of D a + C v + c + b∘v over the base parameters.",
        arguments: ARGUMENTS,
        shape: Shape(&[Axis::Joints, Axis::BaseParameters]),
        linear: Some(("D a + C v + c + b∘v", "PASSIVITY_PARAMETERS")),
        choices: Some(&[Choice::Travel]),
        by_differences: true,
        gravity: true,
        ..Facts::PLAIN
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let (motion, columns) = (at.motion, at.columns);
        let wished = [&motion.v[..], &motion.a[..]];
        let rows = (at.formulation).passivity_regressor(at.arm, at.at, &motion.qd, wished, columns);
        rows.into_iter().flatten().collect()
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        let (motion, travel) = (at.motion, at.form.travel);
        let wished = [&motion.v[..], &motion.a[..]];
        let rows = (at.chain).passivity_regressor(at.at, &motion.qd, wished, travel);
        Some(rows.into_iter().flatten().collect())
    }
}
