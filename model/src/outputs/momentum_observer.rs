//! What an observer of outside forces integrates: p = D q̇ and β = Cᵀq̇ − c − b∘q̇, with
//! ṗ = τ + β + τ_outside (De Luca and Mattone, "Sensorless robot collision detection and
//! hybrid force/motion control", 2005).

use alloc::vec::Vec;

use super::formula::Formula;
use super::function::Definition;
use super::quantity::{Choice, Facts, load};
use super::{Argument, PayloadDependence, Quantity, Regrouped, Shape, Written};
use crate::equations::friction::Friction;
use crate::equations::matrix::minus;
use crate::scalar::{Divide, Scalar};

pub(super) const FUNCTION: Definition = Definition {
    name: "momentum_observer",
    summary: "Momentum p = D q̇ and its drift β = Cᵀq̇ - c - b∘q̇: ṗ = τ + β but for outside forces.",
    results: &[Quantity::Momentum, Quantity::MomentumDrift],
    structure: Some("MomentumObserver"),
    ..Definition::PLAIN
};

/// β_i
pub(super) struct MomentumDrift;

/// Returns Cᵀq̇ − c less the torques of friction.
fn drift<'a, S: Scalar + 'a>(
    slope: Vec<S>,
    gravity: Vec<S>,
    friction: impl Iterator<Item = &'a Friction<S>>,
    qd: &[S],
) -> Vec<S> {
    let rest = slope.iter().zip(&gravity).map(|(slope, c)| minus(slope, c));
    let rest = rest.zip(friction.zip(qd));
    rest.map(|(rest, (friction, qd))| minus(&rest, &friction.torque(qd)))
        .collect()
}

impl Formula for MomentumDrift {
    const FACTS: Facts = Facts {
        field: "drift",
        letter: "β",
        symbol: "β",
        summary: "Drift β = Cᵀq̇ - c - b∘q̇ of the momentum.",
        arguments: &[Argument::Position, Argument::Velocity],
        shape: Shape::VECTOR,
        unit: load,
        given: Some("momentum_drift"),
        choices: Some(&[Choice::Travel]),
        payload_dependence: PayloadDependence::Torque,
        gravity: true,
        ..Facts::PLAIN
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let (arm, qd) = (at.arm, &at.motion.qd);
        let slope = at.formulation.momentum_slope(arm, at.at, qd);
        let gravity = at.formulation.gravity(arm, at.at);
        let friction = arm.links.iter().map(|link| &link.friction);
        drift(slope, gravity, friction, qd)
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        let qd = &at.motion.qd;
        let [_, slope] = at.chain.momentum(at.at, qd);
        let gravity = at.composite.gravity(at.form.travel);
        let friction = at.chain.links.iter().map(|link| &link.friction);
        Some(drift(slope, gravity, friction, qd))
    }
}
