//! Points of a robot that the ground holds.

use alloc::vec::Vec;

use super::formula::Formula;
use super::forward_dynamics::{Acceleration, rest};
use super::operational::factor;
use super::quantity::{Choice, Facts, FrameChoice};
use super::torques::torques;
use super::{Argument, Axis, ErrorScale, Index, PayloadDependence, Regrouped, Shape, Written};
use crate::equations::chain::HandChoice;
use crate::equations::contact::{ContactSpace, held};
use crate::equations::factor::picked;
use crate::equations::following::{gathered, gathered_rows};
use crate::equations::forward::free;
use crate::equations::link_axes::SeenHand;
use crate::equations::matrix::{columns_of, differences, products, sums, zeros};
use crate::scalar::Divide;

pub(super) struct ContactJacobians;

impl Formula for ContactJacobians {
    const FACTS: Facts = Facts {
        field: "contact_jacobians",
        letter: "J",
        symbol: "J(contacts)",
        summary: "Velocities of points in contact by each coordinate, in base axes.",
        arguments: &[Argument::Position],
        shape: Shape(&[Axis::Fixed(3), Axis::Coordinates]),
        unit: |at| match at {
            [_, Index::Turning] => "m",
            _ => "1",
        },
        given: Some("contact_jacobians"),
        depends_on_base: true,
        frame: FrameChoice::Frames,
        ..Facts::PLAIN
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let points = at.arm.in_contact().into_iter();
        let rows = points.flat_map(|arm| at.formulation.task_jacobian(&arm, at.at));
        rows.flatten().collect()
    }
}

pub(super) struct ContactBias;

impl Formula for ContactBias {
    const FACTS: Facts = Facts {
        field: "contact_bias",
        letter: "a",
        symbol: "J̇q̇(contacts)",
        summary: "Accelerations of points in contact that velocities alone give, in base axes.",
        arguments: &[Argument::Position, Argument::Velocity],
        shape: Shape(&[Axis::Fixed(3)]),
        unit: |_| "m/s²",
        given: Some("contact_bias"),
        ..ContactJacobians::FACTS
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        at.formulation.contact_bias(at.arm, at.at, &at.motion.qd)
    }
}

pub(super) struct HeldAcceleration;

fn written_space<S: Divide>(at: &Written<'_, S>) -> ContactSpace<S> {
    let (form, motion) = (at.formulation, at.motion);
    let inputs = [&motion.qd[..], &motion.tau, &motion.damping];
    form.contact_space(at.arm, at.at, inputs, &motion.moves)
}

/// λ² 1 is the same in all axes: each point has those of the link that it is on, or others.
fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<[Vec<S>; 2]> {
    let (motion, whole) = (at.motion, at.textbook.as_ref()?);
    let points = whole.arm.in_contact();
    let hand = |arm| SeenHand::new(whole.formulation, (arm, whole.at), at.form.hand.axes);
    let hands: Vec<SeenHand<'_, S>> = points.iter().map(hand).collect();
    let rows: Vec<Vec<S>> = hands
        .iter()
        .flat_map(SeenHand::jacobian)
        .map(|row| at.pick(&row))
        .collect();
    let jacobian = gathered_rows(at.following, rows);
    let rates: Vec<S> = hands
        .iter()
        .flat_map(|hand| hand.rate(&whole.motion.qd))
        .collect();
    let [taken, reference] = match at.following.is_empty() && !at.form.composite_h {
        true => (at.chain).reference_load(at.at, &motion.qd, &motion.moves, at.form),
        false => {
            let rest = zeros(motion.qd.len());
            [gathered(at.following, torques(at, &rest)), rest]
        }
    };
    let tau = gathered(at.following, motion.tau.clone());
    let inputs = [&differences(&tau, &taken)[..], &reference];
    let known = (&jacobian[..], &rates[..]);
    let [accelerations, forces] = held(
        known,
        &factor(at),
        inputs,
        &motion.damping[0],
        &motion.moves,
    );
    let forces = hands
        .iter()
        .zip(forces.chunks(3))
        .flat_map(|(hand, force)| hand.turned(&[force.to_vec()]).concat());
    Some([accelerations, forces.collect()])
}

impl Formula for HeldAcceleration {
    const FACTS: Facts = Facts {
        field: "qdd",
        letter: "q̈",
        symbol: "q̈(contacts)",
        summary: "Accelerations q̈ while the points are held.",
        arguments: &[
            Argument::Position,
            Argument::Velocity,
            Argument::Torque,
            Argument::Damping,
        ],
        shape: Shape::VECTOR,
        unit: Acceleration::FACTS.unit,
        scale: ErrorScale::None,
        given: Some("qdd_in_contact"),
        choices: Some(&[Choice::Recursion, Choice::Travel]),
        hand: HandChoice::Axes,
        inverts_inertia: true,
        payload_dependence: PayloadDependence::Torque,
        gravity: true,
        ..ContactJacobians::FACTS
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        written_space(at).accelerations()
    }

    fn divisor<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        written_space(at).matrix.concat()
    }

    /// Returns D q̈ + h + c − τ − Jᵀ f
    fn residual<S: Divide>(at: &Written<'_, S>, qdd: &[S]) -> Vec<S> {
        let jacobian = at.formulation.contact_jacobians(at.arm, at.at);
        let pushed = products(&columns_of(&jacobian), &written_space(at).forces());
        let pushed = picked(&pushed, &free(&at.motion.moves));
        differences(&rest(at, qdd, &at.motion.tau), &pushed)
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        let [accelerations, _] = regrouped(at)?;
        Some(accelerations)
    }
}

pub(super) struct ContactForces;

impl Formula for ContactForces {
    const FACTS: Facts = Facts {
        field: "forces",
        letter: "f",
        summary: "Forces on the points, in base axes.",
        shape: Shape(&[Axis::Fixed(3)]),
        unit: |_| "N",
        given: Some("contact_forces"),
        ..HeldAcceleration::FACTS
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        written_space(at).forces()
    }

    fn divisor<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        HeldAcceleration::divisor(at)
    }

    /// Returns (J D⁻¹ Jᵀ + λ² 1) f + J q̈₀ + J̇q̇
    fn residual<S: Divide>(at: &Written<'_, S>, forces: &[S]) -> Vec<S> {
        let space = written_space(at);
        sums(&products(&space.matrix, forces), &space.escape)
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        let [_, forces] = regrouped(at)?;
        Some(forces)
    }
}
