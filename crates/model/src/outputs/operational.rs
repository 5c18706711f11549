//! Dynamics in the space of the hand.

use alloc::vec::Vec;

use super::formula::Formula;
use super::forward_dynamics::beside_one;
use super::quantity::{Choice, Facts, FrameChoice, by_turns};
use super::torques::torques;
use super::{Argument, Axis, Index, PayloadDependence, Regrouped, Shape, Written};
use crate::equations::chain::HandChoice;
use crate::equations::factor::{Factor, submatrix};
use crate::equations::following::{gathered, gathered_rows};
use crate::equations::forward::free;
use crate::equations::link_axes::SeenHand;
use crate::equations::matrix::{Matrix, zeros};
use crate::equations::operational::{NormalEquations, TaskSpace, driven_by};
use crate::scalar::Divide;

pub(super) struct OperationalInertiaInverse;

pub(super) const OF_HAND: Facts = Facts {
    choices: Some(&[Choice::Travel]),
    hand: HandChoice::Axes,
    inverts_inertia: true,
    depends_on_base: true,
    payload_dependence: PayloadDependence::Torque,
    frame: FrameChoice::Rows,
    ..Facts::PLAIN
};

pub(super) fn written_space<S: Divide>(at: &Written<'_, S>) -> TaskSpace<S> {
    at.formulation.task_space(at.arm, at.at, &at.motion.moves)
}

pub(super) fn hand<'a, S: Divide>(at: &Regrouped<'a, S>) -> Option<SeenHand<'a, S>> {
    let whole = at.textbook.as_ref()?;
    let arm = (whole.arm, whole.at);
    Some(SeenHand::new(whole.formulation, arm, at.form.hand.axes))
}

fn chain_jacobian<S: Divide>(at: &Regrouped<'_, S>, hand: &SeenHand<'_, S>) -> Matrix<S> {
    let jacobian = hand.jacobian();
    let rows = jacobian.iter().map(|row| at.pick(row));
    gathered_rows(at.following, rows.collect())
}

pub(super) fn factor<S: Divide>(at: &Regrouped<'_, S>) -> Factor<S> {
    let d = at.gathered_inertia();
    Factor::new(&submatrix(&d, &free(&at.motion.moves)))
}

pub(super) fn space<S: Divide>(at: &Regrouped<'_, S>, hand: &SeenHand<'_, S>) -> TaskSpace<S> {
    TaskSpace::by_factor(chain_jacobian(at, hand), &factor(at), &at.motion.moves)
}

fn normal<S: Divide>(at: &Regrouped<'_, S>, hand: &SeenHand<'_, S>) -> Option<NormalEquations<S>> {
    let jacobian = at.form.hand.normal.then(|| chain_jacobian(at, hand))?;
    let (inertia, motion) = (at.gathered_inertia(), at.motion);
    NormalEquations::new(&jacobian, &inertia, &motion.damping[0], &motion.moves)
}

fn angular(at: &[Index]) -> i32 {
    let turns = |at: &Index| i32::from(matches!(at, Index::Fixed(3..) | Index::Turning));
    at.iter().map(turns).sum()
}

impl Formula for OperationalInertiaInverse {
    const FACTS: Facts = Facts {
        field: "operational_inertia_inverse",
        letter: "Λ⁻¹",
        summary: "Mobility Λ⁻¹ of the hand, linear over angular.",
        arguments: &[Argument::Position],
        shape: Shape(&[Axis::Fixed(6), Axis::Fixed(6)]),
        unit: |at| by_turns(angular(at), ["1/kg", "1/(kg·m)", "1/(kg·m²)"]),
        given: Some("operational_inertia_inverse"),
        ..OF_HAND
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        written_space(at).mobility.concat()
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        let hand = hand(at)?;
        Some(hand.turned_matrix(&space(at, &hand).mobility).concat())
    }
}

pub(super) struct OperationalInertia;

pub(super) fn damped_mobility<S: Divide>(at: &Written<'_, S>) -> Matrix<S> {
    written_space(at).damped(&at.motion.damping[0])
}

impl Formula for OperationalInertia {
    const FACTS: Facts = Facts {
        field: "operational_inertia",
        letter: "Λ",
        summary: "Inertia Λ of the hand, linear over angular.",
        arguments: &[Argument::Position, Argument::Damping],
        unit: |at| by_turns(angular(at), ["kg", "kg·m", "kg·m²"]),
        given: Some("operational_inertia"),
        ..OperationalInertiaInverse::FACTS
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        written_space(at).inertia(&at.motion.damping[0]).concat()
    }

    /// Returns (Λ⁻¹ + λ² 1) Λ − 1
    fn residual<S: Divide>(at: &Written<'_, S>, inertia: &[S]) -> Vec<S> {
        let matrix = damped_mobility(at);
        let rows: Vec<usize> = (0..matrix.len()).collect();
        beside_one(&matrix, inertia, &rows)
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        let hand = hand(at)?;
        let inertia = space(at, &hand).inertia(&at.motion.damping[0]);
        Some(hand.turned_matrix(&inertia).concat())
    }
}

pub(super) struct ConsistentInverse;
impl Formula for ConsistentInverse {
    const FACTS: Facts = Facts {
        field: "consistent_inverse",
        letter: "J̄",
        summary: "Dynamically consistent inverse J̄ of the Jacobian.",
        arguments: &[Argument::Position, Argument::Damping],
        shape: Shape(&[Axis::Coordinates, Axis::Fixed(6)]),
        unit: |at| match at {
            [Index::Turning, Index::Fixed(..3)] => "1/m",
            [Index::Sliding, Index::Fixed(3..)] => "m",
            _ => "1",
        },
        given: Some("consistent_inverse"),
        hand: HandChoice::Normal,
        ..OF_HAND
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let damping = &at.motion.damping[0];
        written_space(at).consistent_inverse(damping).concat()
    }

    /// Returns D J̄ (Λ⁻¹ + λ² 1) − Jᵀ over the joints that move.
    fn residual<S: Divide>(at: &Written<'_, S>, inverse: &[S]) -> Vec<S> {
        let matrix = damped_mobility(at);
        let d = at.formulation.gathered_inertia(at.arm, at.at);
        let j = at.formulation.gathered_jacobian(at.arm, at.at);
        let (m, moves) = (j.len(), &at.motion.moves);
        let sum = |products: &mut dyn Iterator<Item = S>| {
            products.fold(S::zero(), |sum, product| sum.add(&product))
        };
        let entry =
            |i: usize, r: usize| sum(&mut (0..m).map(|s| inverse[i * m + s].mul(&matrix[s][r])));
        let moving = (0..moves.len()).filter(|&i| moves[i]);
        let mut residual = Vec::new();
        for (r, row) in j.iter().enumerate() {
            let column: Vec<S> = (0..moves.len()).map(|k| entry(k, r)).collect();
            for i in moving.clone() {
                let left = sum(&mut column.iter().zip(&d[i]).map(|(x, d)| d.mul(x)));
                residual.push(left.sub(&row[i]));
            }
        }
        residual
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        let hand = hand(at)?;
        let inverse = match normal(at, &hand) {
            Some(normal) => normal.consistent_inverse(),
            None => space(at, &hand).consistent_inverse(&at.motion.damping[0]),
        };
        Some(hand.turned(&inverse).concat())
    }
}

pub(super) struct OperationalBias;
impl Formula for OperationalBias {
    const FACTS: Facts = Facts {
        field: "operational_bias",
        letter: "μ",
        summary: "Bias force μ of the hand, force over moment.",
        arguments: &[Argument::Position, Argument::Velocity, Argument::Damping],
        shape: Shape(&[Axis::Fixed(6)]),
        unit: |at| match at {
            [Index::Fixed(..3)] => "N",
            _ => "N·m",
        },
        given: Some("operational_bias"),
        choices: Some(&[Choice::Recursion, Choice::Travel]),
        gravity: true,
        ..OF_HAND
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let (form, motion) = (at.formulation, at.motion);
        let damping = &motion.damping[0];
        form.operational_bias(at.arm, at.at, &motion.qd, damping, &motion.moves)
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        let motion = at.motion;
        let (hand, qd) = (hand(at)?, &at.textbook.as_ref()?.motion.qd);
        let chain = at.chain.clone().without_friction();
        let mut free = at.clone();
        free.chain = &chain;
        let loads = gathered(at.following, torques(&free, &zeros(motion.qd.len())));
        let (jacobian, factor) = (chain_jacobian(at, &hand), factor(at));
        let driven = driven_by(&jacobian, &factor, &loads, &motion.moves);
        let space = TaskSpace::by_factor(jacobian, &factor, &motion.moves);
        let bias = space.bias(&driven, &hand.rate(qd), &motion.damping[0]);
        Some(hand.turned(&[bias]).concat())
    }
}

/// Torques through Nᵀ do not accelerate the hand.
pub(super) struct NullSpace;
impl Formula for NullSpace {
    const FACTS: Facts = Facts {
        field: "null_space",
        letter: "N",
        summary: "Null-space projector N = 1 - J̄ J.",
        shape: Shape::MATRIX,
        unit: |at| match at {
            [Index::Turning, Index::Sliding] => "1/m",
            [Index::Sliding, Index::Turning] => "m",
            _ => "1",
        },
        given: Some("null_space_projector"),
        ..ConsistentInverse::FACTS
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let motion = at.motion;
        let projector = written_space(at).null_space(&motion.damping[0], &motion.moves);
        projector.concat()
    }

    fn regrouped<S: Divide>(at: &Regrouped<'_, S>) -> Option<Vec<S>> {
        let motion = at.motion;
        let hand = hand(at)?;
        let projector = match normal(at, &hand) {
            Some(normal) => normal.null_space(),
            None => space(at, &hand).null_space(&motion.damping[0], &motion.moves),
        };
        Some(projector.concat())
    }
}
