//! Λ⁻¹ = J D⁻¹ Jᵀ, the mobility of the hand: its acceleration under a unit wrench.

use alloc::vec::Vec;

use super::formula::Formula;
use super::function::Definition;
use super::quantity::{Choice, Facts, FrameChoice};
use super::{Argument, Axis, Index, PayloadDependence, Quantity, Regrouped, Shape, Written};
use crate::equations::chain::HandChoice;
use crate::equations::factor::{Factor, submatrix};
use crate::equations::following::gathered_rows;
use crate::equations::forward::free;
use crate::equations::link_axes::SeenHand;
use crate::equations::operational::{NormalEquations, TaskSpace};
use crate::scalar::Divide;

pub(super) const FUNCTION: Definition = Definition {
    name: "operational_inertia_inverse",
    summary: "Mobility of the hand, the inverse of its inertia: Λ⁻¹ = J D⁻¹ Jᵀ, symmetric.",
    results: &[Quantity::OperationalInertiaInverse],
    ..Definition::PLAIN
};

/// (Λ⁻¹)_rs
pub(super) struct OperationalInertiaInverse;

/// The facts of most quantities of the hand.
pub(super) const OF_HAND: Facts = Facts {
    choices: Some(&[Choice::Travel]),
    hand: HandChoice::Axes,
    depends_on_base: true,
    payload_dependence: PayloadDependence::Torque,
    frame: FrameChoice::Rows,
    ..Facts::PLAIN
};

/// Returns what follows from J and D by the textbook.
pub(super) fn written_space<S: Divide>(at: &Written<'_, S>) -> TaskSpace<S> {
    at.formulation.task_space(at.arm, at.at, &at.motion.moves)
}

/// Returns the hand of the arm, seen as the form says.
pub(super) fn hand<'a, S: Divide>(at: &Regrouped<'a, S>) -> Option<SeenHand<'a, S>> {
    let whole = at.textbook.as_ref()?;
    let arm = (whole.arm, whole.at);
    Some(SeenHand::new(whole.formulation, arm, at.form.hand.axes))
}

/// Returns J′ over the joints of the chain, gathered at the leaders of those that follow.
pub(super) fn chain_jacobian<S: Divide>(
    at: &Regrouped<'_, S>,
    hand: &SeenHand<'_, S>,
) -> Vec<Vec<S>> {
    let rows = hand.jacobian();
    let rows = rows.iter().map(|row| at.pick(row));
    gathered_rows(at.following, rows.collect())
}

/// Returns the factors of D over the joints of the chain that move.
pub(super) fn factor<S: Divide>(at: &Regrouped<'_, S>) -> Factor<S> {
    let d = at.gathered_inertia();
    Factor::new(&submatrix(&d, &free(&at.motion.moves)))
}

/// Returns what follows from J′ and D's factors.
pub(super) fn space<S: Divide>(at: &Regrouped<'_, S>, hand: &SeenHand<'_, S>) -> TaskSpace<S> {
    TaskSpace::by_factor(chain_jacobian(at, hand), &factor(at), &at.motion.moves)
}

/// Returns J̄ and N by normal equations, if the form says so and there are such.
pub(super) fn normal<S: Divide>(
    at: &Regrouped<'_, S>,
    hand: &SeenHand<'_, S>,
) -> Option<NormalEquations<S>> {
    let jacobian = at.form.hand.normal.then(|| chain_jacobian(at, hand))?;
    let (inertia, motion) = (at.gathered_inertia(), at.motion);
    NormalEquations::new(&jacobian, &inertia, &motion.damping[0], &motion.moves)
}

/// Counts how many of two components are turns: of a unit in two powers of metres.
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
        let hand = hand(at)?;
        Some(hand.turned_matrix(space(at, &hand).mobility()).concat())
    }
}
