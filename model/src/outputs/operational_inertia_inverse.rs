//! Λ⁻¹ = J D⁻¹ Jᵀ, the mobility of the hand: its acceleration under a unit wrench.

use alloc::vec::Vec;

use super::formula::Formula;
use super::function::Definition;
use super::quantity::FrameChoice;
use super::quantity::{Choices, Facts};
use super::{Argument, Axis, Index, PayloadDependence, Quantity, Regrouped, Shape, Written};
use crate::equations::factor::{Factor, submatrix};
use crate::equations::following::gathered_rows;
use crate::equations::forward::free;
use crate::equations::operational::TaskSpace;
use crate::scalar::Divide;

pub(super) const FUNCTION: Definition = Definition {
    name: "operational_inertia_inverse",
    summary: "Mobility of the hand, the inverse of its inertia: Λ⁻¹ = J D⁻¹ Jᵀ, symmetric.",
    results: &[Quantity::OperationalInertiaInverse],
    structure: None,
    by_default: false,
    parts: &[],
};

/// (Λ⁻¹)_rs
pub(super) struct OperationalInertiaInverse;

/// The facts of most quantities of the hand.
pub(super) const OF_HAND: Facts = Facts {
    choices: Some(Choices {
        recursion: false,
        travel: true,
        flows: false,
    }),
    depends_on_base: true,
    payload_dependence: PayloadDependence::Torque,
    frame: FrameChoice::Rows,
    ..Facts::PLAIN
};

/// What follows from J and D by the textbook.
pub(super) fn written_space<S: Divide>(at: &Written<'_, S>) -> TaskSpace<S> {
    at.formulation.task_space(at.arm, at.at, &at.motion.moves)
}

/// J of the arm over the joints of the chain, gathered at the leaders of those that follow.
pub(super) fn chain_jacobian<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<Vec<S>>> {
    let textbook = at.textbook.as_ref()?;
    let jacobian = textbook
        .formulation
        .task_jacobian(textbook.arm, textbook.at);
    let rows = jacobian.iter().map(|row| at.pick(row));
    Some(gathered_rows(at.following, rows.collect()))
}

/// The factors of D over the joints of the chain that move.
pub(super) fn factor<S: Divide>(at: &Regrouped<'_, S>) -> Factor<S> {
    let d = at.gathered_inertia();
    Factor::new(&submatrix(&d, &free(&at.motion.moves)))
}

/// What follows from J and D's factors.
pub(super) fn space<S: Divide>(at: &Regrouped<'_, S>) -> Option<TaskSpace<S>> {
    let jacobian = chain_jacobian(at)?;
    Some(TaskSpace::by_factor(
        jacobian,
        &factor(at),
        &at.motion.moves,
    ))
}

/// Of how many of two components are turns: of a unit in two powers of metres.
pub(super) fn angular(at: &[Index]) -> usize {
    let turns = |at: &&Index| matches!(at, Index::Fixed(3..) | Index::Turning);
    at.iter().filter(turns).count()
}

impl Formula for OperationalInertiaInverse {
    const FACTS: Facts = Facts {
        field: "operational_inertia_inverse",
        letter: "Λ⁻¹",
        symbol: "Λ⁻¹",
        summary: "Mobility Λ⁻¹ of the hand, linear over angular.",
        arguments: &[Argument::Position],
        shape: Shape(&[Axis::Fixed(6), Axis::Fixed(6)]),
        unit: |at| match angular(at) {
            0 => "1/kg",
            1 => "1/(kg·m)",
            _ => "1/(kg·m²)",
        },
        given: Some("operational_inertia_inverse"),
        ..OF_HAND
    };

    const INVERTS_INERTIA: bool = true;

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        written_space(at).mobility().concat()
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        Some(space(at)?.mobility().concat())
    }
}
