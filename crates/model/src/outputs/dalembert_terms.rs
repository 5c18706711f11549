//! D^rot, D^tran, h^rot and h^tran of generalized D'Alembert (eqs. 4.2–4.5).

use alloc::vec::Vec;

use super::formula::Formula;
use super::quantity::{Facts, kilograms, load, turns};
use super::{Argument, ErrorScale, PayloadDependence, Shape, Written};
use crate::equations::dalembert::Part;
use crate::scalar::Divide;

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
        ..Facts::PLAIN
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let d = at.formulation.inertia_part(Part::Rotation, at.arm, at.at);
        d.concat()
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
        shape: Shape::VECTOR,
        unit: load,
        scale: ErrorScale::Load,
        payload_dependence: PayloadDependence::Full,
        ..Facts::PLAIN
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let qd = &at.motion.qd;
        at.formulation
            .velocity_part(Part::Rotation, at.arm, at.at, qd)
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
        let qd = &at.motion.qd;
        at.formulation
            .velocity_part(Part::Translation, at.arm, at.at, qd)
    }
}
