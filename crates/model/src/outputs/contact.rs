//! A wrench that acts on the hand, and points of a robot that the ground holds.

use alloc::vec::Vec;

use super::Argument::{Acceleration, Damping, Position, Torque, Velocity, Wrench};
use super::formula::Formula;
use super::forward_dynamics::{self, accelerations, rest};
use super::operational::{OF_HAND, OperationalBias, factor};
use super::quantity::{Choice, Facts, FrameChoice, load};
use super::torques::torques;
use super::{Axis, ErrorScale, Index, PayloadDependence, Regrouped, Shape, Written};
use crate::equations::chain::{HandChoice, Unknowns};
use crate::equations::contact::{ContactSpace, held, squared};
use crate::equations::factor::picked;
use crate::equations::following::{gathered, gathered_rows};
use crate::equations::forward::free;
use crate::equations::link_axes::SeenHand;
use crate::equations::matrix::{Matrix, columns_of, differences, products, sums, zeros};
use crate::equations::operational::damped;
use crate::scalar::Divide;

pub(super) struct ContactTorque;

pub(super) fn of_wrench<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
    (at.formulation).torques_of_wrench(at.arm, at.at, &at.motion.wrench)
}

impl Formula for ContactTorque {
    const FACTS: Facts = Facts {
        field: "tau",
        letter: "τ",
        symbol: "τ(w)",
        summary: "Torques τ beside the wrench.",
        arguments: &[Position, Velocity, Acceleration, Wrench],
        shape: Shape::VECTOR,
        unit: load,
        scale: ErrorScale::Load,
        given: Some("tau_with_wrench"),
        choices: Some(&[Choice::Recursion]),
        inverts_inertia: false,
        gravity: true,
        frame: FrameChoice::Axes,
        hand: HandChoice::None,
        ..OF_HAND
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let (form, motion) = (at.formulation, at.motion);
        let torques = form.inverse_dynamics(at.arm, at.at, &motion.qd, &motion.qdd);
        differences(&torques, &of_wrench(at))
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        let wrench = at.pick(&of_wrench(at.textbook.as_ref()?));
        Some(differences(&torques(at, &at.motion.qdd), &wrench))
    }
}

pub(super) struct ContactAcceleration;
impl Formula for ContactAcceleration {
    const FACTS: Facts = Facts {
        field: "qdd",
        letter: "q̈",
        symbol: "q̈(w)",
        summary: "Accelerations q̈ under the wrench.",
        arguments: &[Position, Velocity, Torque, Wrench],
        unit: forward_dynamics::Acceleration::FACTS.unit,
        scale: ErrorScale::None,
        given: Some("qdd_with_wrench"),
        choices: Some(&[Choice::Recursion, Choice::Travel]),
        inverts_inertia: true,
        has_shoulder: true,
        ..ContactTorque::FACTS
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let (form, motion) = (at.formulation, at.motion);
        let tau = sums(&motion.tau, &of_wrench(at));
        form.forward_dynamics(at.arm, at.at, &motion.qd, &tau, &motion.moves)
    }

    fn residual<S: Divide>(at: &Written<'_, S>, qdd: &[S]) -> Vec<S> {
        rest(at, qdd, &sums(&at.motion.tau, &of_wrench(at)))
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        let wrench = at.pick(&of_wrench(at.textbook.as_ref()?));
        let mut motion = at.motion.clone();
        motion.tau = sums(&motion.tau, &wrench);
        let mut pushed = at.clone();
        pushed.motion = &motion;
        Some(accelerations(&pushed, Unknowns::AgainstBase))
    }
}

/// The wrench that torques of it alone say, such as those that an observer of momentum finds.
pub(super) struct ContactWrench;
impl Formula for ContactWrench {
    const FACTS: Facts = Facts {
        field: "contact_wrench",
        letter: "ŵ",
        summary: "Wrench ŵ, force over moment.",
        arguments: &[Position, Torque, Damping],
        shape: Shape(&[Axis::Fixed(6)]),
        unit: OperationalBias::FACTS.unit,
        given: Some("contact_wrench"),
        depends_on_base: true,
        frame: FrameChoice::Rows,
        ..Facts::PLAIN
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let (form, motion) = (at.formulation, at.motion);
        let inputs = [motion.tau.as_slice(), &motion.damping];
        form.wrench_of_torques(at.arm, at.at, inputs, &motion.moves)
    }

    fn divisor<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let [_, matrix] = normal(at);
        matrix.concat()
    }

    /// Returns (J Jᵀ + λ² 1) ŵ − J τ
    fn residual<S: Divide>(at: &Written<'_, S>, wrench: &[S]) -> Vec<S> {
        let [j, matrix] = normal(at);
        let (left, right) = (products(&matrix, wrench), products(&j, &at.motion.tau));
        left.iter().zip(&right).map(|(a, b)| a.sub(b)).collect()
    }
}

/// Returns J and J Jᵀ + λ² 1.
fn normal<S: Divide>(at: &Written<'_, S>) -> [Matrix<S>; 2] {
    let motion = at.motion;
    let j = at.formulation.moving_jacobian(at.arm, at.at, &motion.moves);
    let matrix = damped(&squared(&j), &motion.damping[0]);
    [j, matrix]
}

pub(super) struct ContactJacobians;
impl Formula for ContactJacobians {
    const FACTS: Facts = Facts {
        field: "contact_jacobians",
        letter: "J",
        symbol: "J(contacts)",
        summary: "Velocities of points in contact by each coordinate, in base axes.",
        arguments: &[Position],
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
        arguments: &[Position, Velocity],
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
    let jacobians = hands.iter().flat_map(SeenHand::jacobian);
    let rows: Matrix<S> = jacobians.map(|row| at.pick(&row)).collect();
    let jacobian = gathered_rows(at.following, rows);
    let qd = &whole.motion.qd;
    let rates: Vec<S> = hands.iter().flat_map(|hand| hand.rate(qd)).collect();
    let [taken, reference] = match at.following.is_empty() && !at.form.composite_h {
        true => (at.chain).reference_load(at.at, &motion.qd, &motion.moves, at.form),
        false => {
            let rest = zeros(motion.qd.len());
            [gathered(at.following, torques(at, &rest)), rest]
        }
    };
    let tau = gathered(at.following, motion.tau.clone());
    let inputs = [&differences(&tau, &taken)[..], &reference];
    let (known, damping) = ((&jacobian[..], &rates[..]), &motion.damping[0]);
    let [accelerations, forces] = held(known, &factor(at), inputs, damping, &motion.moves);
    let points = hands.iter().zip(forces.chunks(3));
    let turned = points.flat_map(|(hand, force)| hand.turned(&[force.to_vec()]).concat());
    Some([accelerations, turned.collect()])
}

impl Formula for HeldAcceleration {
    const FACTS: Facts = Facts {
        field: "qdd",
        letter: "q̈",
        symbol: "q̈(contacts)",
        summary: "Accelerations q̈ while the points are held.",
        arguments: &[Position, Velocity, Torque, Damping],
        shape: Shape::VECTOR,
        unit: forward_dynamics::Acceleration::FACTS.unit,
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
        let pushed_joints = picked(&pushed, &free(&at.motion.moves));
        differences(&rest(at, qdd, &at.motion.tau), &pushed_joints)
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
