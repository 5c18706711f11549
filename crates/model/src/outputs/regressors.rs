//! Matrices that torques are linear in parameters by.

use alloc::vec::Vec;

use super::formula::Formula;
use super::quantity::{Choice, Facts};
use super::torques::ARGUMENTS;
use super::{Argument, Axis, Index, Regrouped, Shape, Written};
use crate::scalar::Divide;

/// Y_ik of τ = Y π, with as few columns as there can be.
pub(super) struct BaseRegressor;
impl Formula for BaseRegressor {
    const FACTS: Facts = Facts {
        field: "y",
        letter: "Y",
        summary: "Regressor Y over the base parameters.",
        arguments: &Argument::STATE,
        shape: Shape(&[Axis::Coordinates, Axis::BaseParameters]),
        linear: Some(("τ", "BASE_PARAMETERS")),
        choices: Some(&[Choice::Travel]),
        // Values that it shares with the chain's formulas save a few.
        starts_from_recursion: true,
        gravity: true,
        ..Facts::PLAIN
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let (motion, form) = (at.motion, at.formulation);
        form.regressor(at.arm, at.at, &motion.qd, &motion.qdd, at.columns)
            .concat()
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        let (motion, travel) = (at.motion, at.form.travel);
        let rows = at.chain.regressor(at.at, &motion.qd, &motion.qdd, travel);
        Some(rows.concat())
    }
}

fn unit(at: &[Index]) -> &'static str {
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

pub(super) struct LinkRegressor;
impl Formula for LinkRegressor {
    const FACTS: Facts = Facts {
        symbol: "Y over all links' parameters",
        summary: "Regressor Y over all links' parameters.",
        shape: Shape(&[Axis::Coordinates, Axis::LinkParameters]),
        linear: None,
        unit,
        given: Some("regressor"),
        ..BaseRegressor::FACTS
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        BaseRegressor::written(at)
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        BaseRegressor::regrouped(at)
    }
}

/// Y_ik of D a + C v + c + b∘v = Y π: what adaptive control (Slotine and Li) multiplies its
/// estimate by. It is not the regressor of the torques at other arguments, since C(q, q̇) v has two
/// velocities. With C of the Christoffel symbols Ḋ − 2C is skew, and so the energy of the error
/// falls whatever the estimate is.
pub(super) struct PassivityRegressor;
impl Formula for PassivityRegressor {
    const FACTS: Facts = Facts {
        symbol: "Y of D a + C v + c + b∘v",
        summary: "Regressor Y of D a + C v + c + b∘v over the base parameters.",
        arguments: ARGUMENTS,
        linear: Some(("D a + C v + c + b∘v", "PASSIVITY_PARAMETERS")),
        starts_from_recursion: false,
        by_differences: true,
        ..BaseRegressor::FACTS
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let (motion, columns) = (at.motion, at.columns);
        let wished = [&motion.v[..], &motion.a[..]];
        let rows = (at.formulation).passivity_regressor(at.arm, at.at, &motion.qd, wished, columns);
        rows.concat()
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        let (motion, travel) = (at.motion, at.form.travel);
        let wished = [&motion.v[..], &motion.a[..]];
        let rows = (at.chain).passivity_regressor(at.at, &motion.qd, wished, travel);
        Some(rows.concat())
    }
}
