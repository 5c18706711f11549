//! h, the Coriolis and centripetal load (eqs. 2.14, 4.3, 4.4).

use alloc::vec::Vec;

use super::formula::Formula;
use super::function::Definition;
use super::quantity::{Choice, Facts, load};
use super::{Argument, ErrorScale, PayloadDependence, Quantity, Regrouped, Shape, Written};
use crate::equations::matrix::{zero_vector, zeros};
use crate::scalar::Divide;

pub(super) const FUNCTION: Definition = Definition {
    name: "coriolis",
    summary: "Coriolis and centripetal load h(q, q̇), damping not included.",
    results: &[Quantity::Coriolis],
    by_default: true,
    ..Definition::PLAIN
};

/// h_i
pub(super) struct Coriolis;

impl Formula for Coriolis {
    const FACTS: Facts = Facts {
        field: "h",
        letter: "h",
        symbol: "h",
        summary: "Coriolis and centripetal load h.",
        arguments: &[Argument::Position, Argument::Velocity],
        shape: Shape::VECTOR,
        unit: load,
        scale: ErrorScale::Load,
        given: Some("h"),
        choices: Some(&[Choice::Recursion]),
        payload_dependence: PayloadDependence::Torque,
        ..Facts::PLAIN
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        at.formulation.velocity_terms(at.arm, at.at, &at.motion.qd)
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        let (chain, form) = (at.chain, at.form);
        let rest = zeros(chain.links.len());
        if form.composite_h {
            let still = zero_vector();
            let (qd, exerted) = (&at.motion.qd, zero_vector());
            let torques = at.composite.torques(&still, qd, &rest, form.spin, &exerted);
            return Some(torques);
        }
        let mut still = chain.clone().without_friction();
        still.gravity = zero_vector();
        Some(still.inverse_dynamics(at.at, &at.motion.qd, &rest, form.spin, form.couple))
    }
}
