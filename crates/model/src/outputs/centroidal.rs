//! Momentum about the centre of mass, robots that nothing holds, and blocks of D on a base that floats.

use alloc::vec::Vec;

use super::formula::Formula;
use super::quantity::{Choice, Facts, by_turns, kilograms, load};
use super::torques::Coriolis;
use super::{Argument, Axis, Index, PayloadDependence, Regrouped, Shape, Written};
use crate::equations::BASE_COORDINATES;
use crate::equations::factor::submatrix;
use crate::equations::matrix::{products, sums};
use crate::scalar::Divide;

pub(super) struct CentreOfMass;
impl Formula for CentreOfMass {
    const FACTS: Facts = Facts {
        field: "com",
        letter: "s",
        summary: "Centre of mass in base axes, from the base's origin.",
        arguments: &[Argument::Position],
        shape: Shape(&[Axis::Fixed(3)]),
        unit: |_| "m",
        given: Some("com"),
        choices: Some(&[]),
        depends_on_base: true,
        payload_dependence: PayloadDependence::Full,
        ..Facts::PLAIN
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        at.formulation.centre_of_mass(at.arm, at.at).to_vec()
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        Some(at.composite.centre_of_mass()?.to_vec())
    }
}

pub(super) struct CentroidalMomentumMatrix;

pub(super) fn metres(at: &[Index]) -> i32 {
    let more = |at: &Index| i32::from(matches!(at, Index::Fixed(3..) | Index::Turning));
    at.iter().map(more).sum()
}

impl Formula for CentroidalMomentumMatrix {
    const FACTS: Facts = Facts {
        field: "centroidal_momentum_matrix",
        letter: "A",
        summary: "Momentum of each coordinate about the centre of mass, linear over angular.",
        shape: Shape(&[Axis::Fixed(6), Axis::Coordinates]),
        unit: |at| kilograms(metres(at)),
        given: Some("centroidal_momentum_matrix"),
        ..CentreOfMass::FACTS
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let form = at.formulation;
        form.centroidal_momentum_matrix(at.arm, at.at).concat()
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        Some(at.composite.centroidal_momentum_matrix()?.concat())
    }
}

pub(super) struct CentroidalBias;
impl Formula for CentroidalBias {
    const FACTS: Facts = Facts {
        field: "centroidal_bias",
        letter: "ȧ",
        symbol: "Ȧq̇",
        summary: "Rate of the momentum about the centre of mass where accelerations are zero.",
        arguments: &[Argument::Position, Argument::Velocity],
        shape: Shape(&[Axis::Fixed(6)]),
        unit: |at| by_turns(metres(at), ["N", "N·m", "N·m"]),
        given: Some("centroidal_bias"),
        choices: Some(&[Choice::Recursion]),
        ..CentreOfMass::FACTS
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let qd = &at.motion.qd;
        at.formulation.centroidal_bias(at.arm, at.at, qd).to_vec()
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        at.chain.base.as_ref()?;
        let h = Coriolis::regrouped(at)?;
        Some(at.composite.centroidal_bias(&h)?.to_vec())
    }
}

pub(super) struct FreeTorque;
impl Formula for FreeTorque {
    const FACTS: Facts = Facts {
        field: "tau",
        letter: "τ",
        symbol: "τ(free)",
        summary: "Torques τ, zero of the base.",
        arguments: &Argument::STATE,
        shape: Shape::VECTOR,
        unit: load,
        given: Some("tau_free"),
        choices: Some(&[Choice::Recursion]),
        inverts_inertia: true,
        payload_dependence: PayloadDependence::Torque,
        gravity: true,
        on_floating_base: true,
        ..Facts::PLAIN
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let mut qdd = at.motion.qdd.clone();
        qdd.splice(..BASE_COORDINATES, free_base(at));
        let form = at.formulation;
        let mut torques = form.inverse_dynamics(at.arm, at.at, &at.motion.qd, &qdd);
        torques[..BASE_COORDINATES].fill(S::zero());
        torques
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        let motion = [&at.motion.qd[..], &at.motion.qdd];
        Some(at.composite.in_flight(motion, at.form)?.0)
    }
}

pub(super) struct BaseAcceleration;

fn free_base<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
    (at.formulation).free_base(at.arm, at.at, [&at.motion.qd, &at.motion.qdd])
}

impl Formula for BaseAcceleration {
    const FACTS: Facts = Facts {
        field: "base_acceleration",
        letter: "a",
        symbol: "a(free)",
        summary: "Accelerations of the base, linear over angular.",
        shape: Shape(&[Axis::Fixed(6)]),
        unit: |at| by_turns(metres(at), ["m/s²", "rad/s²", "rad/s²"]),
        given: Some("base_acceleration"),
        ..FreeTorque::FACTS
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        free_base(at)
    }

    /// Returns D_bb a + D_bj q̈_j + h_b + c_b
    fn residual<S: Divide>(at: &Written<'_, S>, base: &[S]) -> Vec<S> {
        let (form, motion) = (at.formulation, at.motion);
        let rows: Vec<usize> = (0..BASE_COORDINATES).collect();
        let base_inertia = submatrix(&form.inertia(at.arm, at.at), &rows);
        let mut rest = motion.qdd.clone();
        rest[..BASE_COORDINATES].fill(S::zero());
        let taken = form.inverse_dynamics(at.arm, at.at, &motion.qd, &rest);
        sums(&products(&base_inertia, base), &taken[..BASE_COORDINATES])
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        let motion = [&at.motion.qd[..], &at.motion.qdd];
        Some(at.composite.in_flight(motion, at.form)?.1.to_vec())
    }
}

/// D_ik, i and k of the base
pub(super) struct BaseInertia;
impl Formula for BaseInertia {
    const FACTS: Facts = Facts {
        field: "base",
        letter: "Dbase",
        summary: "Inertia of the whole robot at the base, linear over angular.",
        arguments: &[Argument::Position],
        shape: Shape(&[Axis::Fixed(6), Axis::Fixed(6)]),
        unit: |at| kilograms(metres(at)),
        choices: Some(&[Choice::Travel]),
        payload_dependence: PayloadDependence::Torque,
        on_floating_base: true,
        ..Facts::PLAIN
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        base(at.formulation.inertia(at.arm, at.at))
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        Some(base(at.composite.inertia(at.form.travel)))
    }
}

fn base<S: Divide>(d: Vec<Vec<S>>) -> Vec<S> {
    let rows: Vec<usize> = (0..BASE_COORDINATES).collect();
    submatrix(&d, &rows).concat()
}

/// D_ik, i of the base and k a joint
pub(super) struct CouplingInertia;
impl Formula for CouplingInertia {
    const FACTS: Facts = Facts {
        field: "coupling",
        letter: "Dcoupling",
        summary: "Inertia that couples the base, linear over angular, and each joint.",
        shape: Shape(&[Axis::Fixed(6), Axis::Links]),
        ..BaseInertia::FACTS
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        at.formulation.inertia(at.arm, at.at)[..BASE_COORDINATES].concat()
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        Some(at.composite.inertia(at.form.travel)[..BASE_COORDINATES].concat())
    }
}

/// D_ik, i and k joints of one limb
pub(super) struct LimbInertia;
impl Formula for LimbInertia {
    const FACTS: Facts = Facts {
        field: "limbs",
        letter: "Dlimb",
        summary: "Inertia between the joints of a limb: one block a limb, one behind the other, each row by row.",
        shape: Shape(&[Axis::Limbs]),
        ..BaseInertia::FACTS
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        at.formulation.inertia(at.arm, at.at).concat()
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        Some(at.composite.inertia(at.form.travel).concat())
    }
}
