//! Energies and momenta.

use alloc::vec;
use alloc::vec::Vec;

use super::formula::Formula;
use super::quantity::{Choice, Facts, by_turns, load, turns};
use super::{Argument, ErrorScale, PayloadDependence, Regrouped, Shape, Written};
use crate::equations::chain::composite::CompositeOrder;
use crate::equations::friction::Friction;
use crate::equations::matrix::{halved, minus, times, total};
use crate::scalar::{Divide, Scalar};

pub(super) struct KineticEnergy;
impl Formula for KineticEnergy {
    const FACTS: Facts = Facts {
        field: "kinetic",
        letter: "T",
        summary: "Kinetic energy T.",
        arguments: &[Argument::Position, Argument::Velocity],
        unit: |_| "J",
        given: Some("kinetic"),
        choices: Some(&[Choice::Travel]),
        payload_dependence: PayloadDependence::Torque,
        ..Facts::PLAIN
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let qd = &at.motion.qd;
        vec![at.formulation.kinetic_energy(at.arm, at.at, qd)]
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        let (chain, qd) = (at.chain, &at.motion.qd);
        Some(vec![match at.form.travel {
            CompositeOrder::Outward => chain.kinetic_energy(at.at, qd),
            CompositeOrder::Inward => {
                let [p, _] = chain.momentum(at.at, qd);
                halved(&total(p.iter().zip(qd).map(|(p, qd)| times(p, qd))))
            }
        }])
    }
}

pub(super) struct PotentialEnergy;
impl Formula for PotentialEnergy {
    const FACTS: Facts = Facts {
        field: "potential",
        letter: "U",
        summary: "Potential energy U.",
        arguments: &[Argument::Position],
        unit: |_| "J",
        given: Some("potential"),
        depends_on_base: true,
        payload_dependence: PayloadDependence::Full,
        gravity: true,
        ..Facts::PLAIN
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        vec![at.formulation.potential_energy(at.arm, at.at)]
    }
}

pub(super) struct Momentum;
impl Formula for Momentum {
    const FACTS: Facts = Facts {
        field: "p",
        letter: "p",
        summary: "Momentum p = D q̇.",
        arguments: &[Argument::Position, Argument::Velocity],
        shape: Shape::VECTOR,
        unit: |at| by_turns(turns(at), ["kg·m/s", "kg·m²/s", "kg·m²/s"]),
        choices: Some(&[]),
        payload_dependence: PayloadDependence::Torque,
        ..Facts::PLAIN
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        at.formulation.momentum(at.arm, at.at, &at.motion.qd)
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        let [p, _] = at.chain.momentum(at.at, &at.motion.qd);
        Some(p)
    }
}

pub(super) struct MomentumSlope;
impl Formula for MomentumSlope {
    const FACTS: Facts = Facts {
        field: "ct_qd",
        letter: "s",
        symbol: "Cᵀq̇",
        summary: "Its slope Cᵀq̇ = ∂T/∂q.",
        unit: load,
        ..Momentum::FACTS
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        at.formulation.momentum_slope(at.arm, at.at, &at.motion.qd)
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        let [_, slope] = at.chain.momentum(at.at, &at.motion.qd);
        Some(slope)
    }
}

/// β_i = (Cᵀq̇ − c − b∘q̇)_i: what an observer of outside forces integrates with p = D q̇, as
/// ṗ = τ + β + τ_outside (De Luca and Mattone, "Sensorless robot collision detection and
/// hybrid force/motion control", 2005).
pub(super) struct MomentumDrift;

fn drift<'a, S: Scalar + 'a>(
    slope: Vec<S>,
    gravity: Vec<S>,
    friction: impl Iterator<Item = &'a Friction<S>>,
    qd: &[S],
) -> Vec<S> {
    let terms = slope.iter().zip(&gravity).zip(friction.zip(qd));
    let drift = terms.map(|((slope, c), (friction, qd))| {
        let rest = minus(slope, c);
        minus(&rest, &friction.torque(qd))
    });
    drift.collect()
}

impl Formula for MomentumDrift {
    const FACTS: Facts = Facts {
        field: "drift",
        letter: "β",
        summary: "Drift β = Cᵀq̇ - c - b∘q̇ of the momentum.",
        arguments: &[Argument::Position, Argument::Velocity],
        scale: ErrorScale::None,
        given: Some("momentum_drift"),
        choices: Some(&[Choice::Travel]),
        gravity: true,
        ..Facts::LOAD
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
        let none = Friction::none();
        let free = core::iter::repeat_n(&none, at.chain.base_coordinates());
        let friction = at.chain.links.iter().map(|link| &link.friction);
        Some(drift(slope, gravity, free.chain(friction), qd))
    }
}
