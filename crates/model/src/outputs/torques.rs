//! Torques, the parts that they are sums of, and those of controllers that use the Coriolis matrix.
//!
//! D^rot, D^tran, h^rot and h^tran are of generalized D'Alembert (eqs. 4.2–4.5).

use alloc::vec::Vec;

use super::formula::Formula;
use super::quantity::{Choice, Facts, by_turns, kilograms, turns};
use super::{Argument, ErrorScale, PayloadDependence, Quantity, Regrouped, Shape, Written};
use crate::equations::dalembert::Part;
use crate::equations::energy::contracted;
use crate::equations::matrix::{zero_vector, zeros};
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
    chain.driven(torques, qd, qdd)
}

impl Formula for Torque {
    const FACTS: Facts = Facts {
        field: "tau",
        letter: "τ",
        summary: "Torques τ.",
        arguments: &Argument::STATE,
        given: Some("tau"),
        choices: Some(&[Choice::Recursion]),
        starts_from_recursion: true,
        gravity: true,
        ..Facts::LOAD
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let (form, motion) = (at.formulation, at.motion);
        form.inverse_dynamics(at.arm, at.at, &motion.qd, &motion.qdd)
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
        given: Some("c"),
        choices: Some(&[Choice::Travel]),
        gravity: true,
        ..Facts::LOAD
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
        unit: |at| kilograms(turns(at)),
        scale: ErrorScale::Inertia,
        given: Some("D"),
        definite: true,
        ..Facts::MATRIX
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
        given: Some("h"),
        choices: Some(&[Choice::Recursion]),
        ..Facts::LOAD
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        at.formulation.velocity_terms(at.arm, at.at, &at.motion.qd)
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        let (chain, form) = (at.chain, at.form);
        let rest = zeros(chain.coordinates());
        let (qd, none) = (&at.motion.qd, zero_vector());
        if form.composite_h {
            let composite = &at.composite;
            return Some(composite.torques(&none, qd, &rest, form.spin, &none));
        }
        let mut still = chain.clone().without_friction();
        still.gravity = none;
        Some(still.inverse_dynamics(at.at, qd, &rest, form.spin, form.couple))
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
        on_fixed_base: true,
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

/// C_ik = Σ_m h_ikm q̇_m
pub(super) struct CoriolisMatrix;
impl Formula for CoriolisMatrix {
    const FACTS: Facts = Facts {
        field: "c_matrix",
        letter: "C",
        summary: "Coriolis matrix C.",
        arguments: &[Argument::Position, Argument::Velocity],
        unit: |at| by_turns(turns(at), ["N·s/m", "N·s", "N·m·s"]),
        choices: Some(&[Choice::Flows]),
        by_differences: true,
        ..Facts::MATRIX
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let c = at.formulation.coriolis_matrix(at.arm, at.at, &at.motion.qd);
        c.concat()
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        let qd = &at.motion.qd;
        // The symbols are those of a fixed base.
        let c = match at.form.flows || at.chain.base.is_some() {
            true => at.composite.coriolis_matrix(qd, at.form.travel),
            false => contracted(&at.composite.christoffel(), qd),
        };
        Some(c.concat())
    }
}

pub(super) const ARGUMENTS: &[Argument] = &[
    Argument::Position,
    Argument::Velocity,
    Argument::ReferenceVelocity,
    Argument::ReferenceAcceleration,
];

/// (D a + C v + c + b∘v)_i: what passivity-based controllers (Slotine and Li) ask of a model,
/// with v and a the velocity and the acceleration wished for.
pub(super) struct Passivity;
impl Formula for Passivity {
    const FACTS: Facts = Facts {
        field: "tau",
        letter: "τ",
        symbol: "D a + C v + c + b∘v",
        summary: "Torques D a + C v + c + b∘v.",
        arguments: ARGUMENTS,
        choices: Some(&[]),
        by_differences: true,
        gravity: true,
        ..Facts::LOAD
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let motion = at.motion;
        let rates = [&motion.qd[..], &motion.v, &motion.a];
        at.formulation.passivity(at.arm, at.at, rates)
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        let motion = at.motion;
        Some(at.chain.passivity(at.at, &motion.qd, &motion.v, &motion.a))
    }
}

pub(super) struct RotationInertia;
impl Formula for RotationInertia {
    const FACTS: Facts = Facts {
        field: "d_rot",
        letter: "Drot",
        summary: "Inertia matrix of the links' rotation D^rot.",
        arguments: &[Argument::Position],
        shape: Shape::MATRIX,
        unit: |at| kilograms(turns(at)),
        scale: ErrorScale::Inertia,
        payload_dependence: PayloadDependence::Full,
        on_fixed_base: true,
        ..Facts::PLAIN
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let form = at.formulation;
        form.inertia_part(Part::Rotation, at.arm, at.at).concat()
    }
}

pub(super) struct TranslationInertia;
impl Formula for TranslationInertia {
    const FACTS: Facts = Facts {
        field: "d_tran",
        letter: "Dtran",
        summary: "Inertia matrix of the links' translation D^tran.",
        ..RotationInertia::FACTS
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let form = at.formulation;
        form.inertia_part(Part::Translation, at.arm, at.at).concat()
    }
}

pub(super) struct RotationCoriolis;
impl Formula for RotationCoriolis {
    const FACTS: Facts = Facts {
        field: "h_rot",
        letter: "hrot",
        summary: "Coriolis and centripetal load of the links' rotation h^rot.",
        arguments: &[Argument::Position, Argument::Velocity],
        payload_dependence: PayloadDependence::Full,
        on_fixed_base: true,
        ..Facts::LOAD
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let (form, qd) = (at.formulation, &at.motion.qd);
        form.velocity_part(Part::Rotation, at.arm, at.at, qd)
    }
}

pub(super) struct TranslationCoriolis;
impl Formula for TranslationCoriolis {
    const FACTS: Facts = Facts {
        field: "h_tran",
        letter: "htran",
        summary: "Coriolis and centripetal load of the links' translation h^tran.",
        ..RotationCoriolis::FACTS
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let (form, qd) = (at.formulation, &at.motion.qd);
        form.velocity_part(Part::Translation, at.arm, at.at, qd)
    }
}

impl Quantity {
    /// Returns the quantity that given states have in its place, at these velocities: h for h_ikm.
    pub fn as_given(self, values: &[f64], qd: &[f64]) -> (Quantity, Vec<f64>) {
        match self {
            Quantity::Christoffel => (Quantity::Coriolis, contract(values, qd)),
            quantity => (quantity, values.to_vec()),
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
