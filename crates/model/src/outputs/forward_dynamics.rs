//! Accelerations under given torques, and the inverse of the inertia matrix.

use alloc::vec::Vec;

use super::formula::Formula;
use super::quantity::{Choice, Facts, by_turns, turns};
use super::torques::torques;
use super::{Argument, PayloadDependence, Regrouped, Shape, Written};
use crate::equations::chain::{EliminatedTip, Unknowns};
use crate::equations::factor::picked;
use crate::equations::following::{gathered, spread};
use crate::equations::forward::{free, inverted, solved};
use crate::equations::matrix::{Matrix, differences, zeros};
use crate::scalar::Divide;

pub(super) struct Acceleration;

/// A last joint that nothing depends on comes first, then D of the others.
pub(super) fn accelerations<S: Divide>(at: &Regrouped<'_, S>, unknowns: Unknowns) -> Vec<S> {
    let motion = at.motion;
    if !at.following.is_empty() {
        let bias = torques(at, &zeros(motion.qd.len()));
        let [bias, tau] = [bias, motion.tau.clone()].map(|loads| gathered(at.following, loads));
        return solved(&at.gathered_inertia(), &bias, &tau, &motion.moves);
    }
    let inputs = [motion.qd.as_slice(), &motion.tau];
    if let Some(unspun) = EliminatedTip::new(&at.composite, &motion.moves) {
        return unspun.forward_dynamics(inputs, &motion.moves, at.form, unknowns);
    }
    let by_shoulder = (at.composite).forward_dynamics_by_shoulder(inputs, &motion.moves, at.form);
    if let Some(accelerations) = by_shoulder {
        return accelerations;
    }
    let d = at.composite.inertia(at.form.travel);
    if !at.form.composite_h {
        let chain = (at.at, d.as_slice());
        return (at.chain).forward_dynamics(chain, inputs, &motion.moves, at.form, unknowns);
    }
    let loads = [&torques(at, &zeros(motion.qd.len()))[..], &motion.tau];
    (at.chain).accelerations(&d, loads, &motion.moves, (at.form, unknowns))
}

pub(super) fn rest<S: Divide>(at: &Written<'_, S>, qdd: &[S], tau: &[S]) -> Vec<S> {
    let (form, motion) = (at.formulation, at.motion);
    let qdd = spread(&at.arm.following, qdd.to_vec());
    let taken = form.inverse_dynamics(at.arm, at.at, &motion.qd, &qdd);
    let rest = gathered(&at.arm.following, differences(&taken, tau));
    picked(&rest, &free(&motion.moves))
}

impl Formula for Acceleration {
    const FACTS: Facts = Facts {
        field: "qdd",
        letter: "q̈",
        summary: "Accelerations q̈.",
        arguments: &[Argument::Position, Argument::Velocity, Argument::Torque],
        shape: Shape::VECTOR,
        unit: |at| by_turns(turns(at), ["m/s²", "rad/s²", "rad/s²"]),
        given: Some("forward_dynamics"),
        choices: Some(&[Choice::Recursion, Choice::Travel]),
        inverts_inertia: true,
        payload_dependence: PayloadDependence::Torque,
        gravity: true,
        has_shoulder: true,
        ..Facts::PLAIN
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let (form, motion) = (at.formulation, at.motion);
        form.forward_dynamics(at.arm, at.at, &motion.qd, &motion.tau, &motion.moves)
    }

    fn residual<S: Divide>(at: &Written<'_, S>, qdd: &[S]) -> Vec<S> {
        rest(at, qdd, &at.motion.tau)
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        Some(accelerations(at, Unknowns::AgainstBase))
    }
}

pub(super) struct InertiaInverse;

/// Returns A X − 1 over these rows and columns.
pub(super) fn beside_one<S: Divide>(a: &[Vec<S>], x: &[S], rows: &[usize]) -> Vec<S> {
    let entry = |(&i, &k): (&usize, &usize)| {
        let one = if i == k { S::one() } else { S::zero() };
        let products = rows.iter().map(|&j| a[i][j].mul(&x[j * a.len() + k]));
        products.fold(one.neg(), |sum, product| sum.add(&product))
    };
    let places = rows.iter().flat_map(|i| rows.iter().map(move |k| (i, k)));
    places.map(entry).collect()
}

pub(super) fn inverse<S: Divide>(at: &Regrouped<'_, S>) -> Matrix<S> {
    let (moves, travel) = (&at.motion.moves, at.form.travel);
    match EliminatedTip::new(&at.composite, moves).filter(|_| at.following.is_empty()) {
        Some(unspun) => unspun.inertia_inverse(moves, travel),
        None => inverted(&at.gathered_inertia(), moves),
    }
}

impl Formula for InertiaInverse {
    const FACTS: Facts = Facts {
        field: "d_inv",
        letter: "D⁻¹",
        summary: "Inverse D⁻¹ of the inertia matrix.",
        arguments: &[Argument::Position],
        unit: |at| by_turns(turns(at), ["1/kg", "1/(kg·m)", "1/(kg·m²)"]),
        given: Some("inertia_inverse"),
        inverts_inertia: true,
        ..Facts::MATRIX
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let inverse = (at.formulation).inertia_inverse(at.arm, at.at, &at.motion.moves);
        inverse.concat()
    }

    /// Returns D D⁻¹ − 1 over the joints that move.
    fn residual<S: Divide>(at: &Written<'_, S>, inverse: &[S]) -> Vec<S> {
        let d = at.formulation.gathered_inertia(at.arm, at.at);
        beside_one(&d, inverse, &free(&at.motion.moves))
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        Some(inverse(at).concat())
    }
}
