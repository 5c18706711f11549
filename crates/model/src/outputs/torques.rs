//! Torques, and the parts that they are sums of.

use alloc::vec::Vec;

use super::formula::Formula;
use super::quantity::{Choice, Facts, kilograms, load, turns};
use super::{Argument, ErrorScale, PayloadDependence, Quantity, Regrouped, Shape, Written};
use crate::equations::matrix::{plus, zero_vector, zeros};
use crate::scalar::{Divide, Scalar};

/// τ_i of τ = D q̈ + h + c + b∘q̇ (eq. 2.3)
pub(super) struct Torque;

pub(super) fn torques<S: Scalar>(at: &Regrouped<'_, S>, qdd: &[S]) -> Vec<S> {
    let (chain, qd, form) = (at.chain, &at.motion.qd, at.form);
    if !form.composite_h {
        return chain.inverse_dynamics(at.at, qd, qdd, form.spin, form.couple);
    }
    let (gravity, exerted) = (&chain.gravity, zero_vector());
    let torques = at.composite.torques(gravity, qd, qdd, form.spin, &exerted);
    let torques = torques.iter().enumerate();
    let driven = torques.map(|(i, torque)| plus(torque, &chain.drive(i, qd, qdd)));
    driven.collect()
}

impl Formula for Torque {
    const FACTS: Facts = Facts {
        field: "tau",
        letter: "τ",
        summary: "Torques τ.",
        arguments: &Argument::STATE,
        shape: Shape::VECTOR,
        unit: load,
        scale: ErrorScale::Load,
        given: Some("tau"),
        choices: Some(&[Choice::Recursion]),
        starts_from_recursion: true,
        payload_dependence: PayloadDependence::Torque,
        gravity: true,
        ..Facts::PLAIN
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let motion = at.motion;
        at.formulation
            .inverse_dynamics(at.arm, at.at, &motion.qd, &motion.qdd)
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        Some(torques(at, &at.motion.qdd))
    }
}

/// c_i (eqs. 2.15, 4.5)
pub(super) struct Gravity;

impl Formula for Gravity {
    const FACTS: Facts = Facts {
        field: "c",
        letter: "c",
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

/// D_ik (eqs. 2.13, 4.2)
pub(super) struct Inertia;

impl Formula for Inertia {
    const FACTS: Facts = Facts {
        field: "d",
        letter: "D",
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
        at.formulation.inertia(at.arm, at.at).concat()
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        Some(at.composite.inertia(at.form.travel).concat())
    }
}

/// h_i (eqs. 2.14, 4.3, 4.4)
pub(super) struct Coriolis;

impl Formula for Coriolis {
    const FACTS: Facts = Facts {
        field: "h",
        letter: "h",
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
        choices: Some(&[]),
        by_differences: true,
        payload_dependence: PayloadDependence::Torque,
        ..Facts::PLAIN
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let h = at.formulation.christoffel(at.arm, at.at);
        h.concat().concat()
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        Some(at.composite.christoffel().concat().concat())
    }
}

impl Quantity {
    /// Returns what given states have of it, from its entries at a state of these velocities:
    /// instead of h_ikm they have h.
    pub fn as_given(self, values: &[f64], qd: &[f64]) -> (Quantity, Vec<f64>) {
        match self {
            Quantity::Christoffel => (Quantity::Coriolis, contract(values, qd)),
            own => (own, values.to_vec()),
        }
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
