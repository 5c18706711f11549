//! D of a robot whose base floats, in blocks: joints of different limbs have no inertia in common.

use alloc::vec::Vec;

use super::centroidal::metres;
use super::formula::Formula;
use super::quantity::{Choice, Facts, kilograms};
use super::{Argument, Axis, PayloadDependence, Regrouped, Shape, Written};
use crate::equations::BASE_COORDINATES;
use crate::equations::factor::submatrix;
use crate::scalar::Divide;

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
