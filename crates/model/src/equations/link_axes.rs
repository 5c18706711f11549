//! The hand's velocity in the axes of links.
//!
//! λ² 1 is the same in all axes, for three linear or three angular components by themselves.
//! So what is asked in base axes may be computed in those of a link, and turned at the end:
//!
//! ```text
//! J = G J′        Λ = G Λ′ Gᵀ        J̄ = J̄′ Gᵀ        μ = G μ′
//! ```
//!
//! In the axes of the link before the hand's the columns of the last joints are mostly zeros
//! and ones, and of a hand that is round about the last joint's axis, Λ⁻¹ has no entries
//! beside that of the axis. Linear components are short in the axes of the first link, in
//! which no lever depends on q_1.

use alloc::vec::Vec;

use super::factor::{picked, placed};
use super::frames::Axes;
use super::kinematics::{by_lever, levers, poses};
use super::matrix::*;
use super::newton_euler::{table1, table2};
use super::{Arm, At, Formulation};
use crate::robot::{Convention, JointKind};
use crate::scalar::Scalar;

/// The axes in which the hand's velocity is while something of it is computed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum HandAxes {
    /// Those that are asked for.
    #[default]
    Asked,
    /// Linear components in the axes of the first link, angular ones in those before the hand's.
    FirstAndLast,
    /// All in the axes of the link before the hand's.
    Last,
}

/// An arm whose hand is seen from links.
#[derive(Clone, Debug)]
pub struct SeenHand<'a, S> {
    by: Formulation,
    arm: &'a Arm<S>,
    at: &'a At<S>,
    /// The links of linear and of angular components; `None` for the axes asked for.
    links: [Option<usize>; 2],
}

impl<'a, S: Scalar> SeenHand<'a, S> {
    /// Returns the hand in the axes of links. The linear part, and the angular one, stays in the
    /// axes asked for unless these are the base's and all three of its components are wanted.
    pub fn new(by: Formulation, (arm, at): (&'a Arm<S>, &'a At<S>), axes: HandAxes) -> Self {
        let last = arm.to_hand(at).1.len().saturating_sub(1);
        let links = match axes {
            HandAxes::Asked => [0, 0],
            HandAxes::FirstAndLast => [last.min(arm.base_joints() + 1), last],
            HandAxes::Last => [last, last],
        };
        let whole = |part: usize| {
            let rows = arm.frames.rows.indices();
            arm.frames.axes == Axes::Mixed && rows.filter(|row| row / 3 == part).count() == 3
        };
        SeenHand {
            by,
            arm,
            at,
            links: [0, 1].map(|part| (links[part] > 0 && whole(part)).then_some(links[part])),
        }
    }

    /// Returns J′, m×n.
    pub fn jacobian(&self) -> Matrix<S> {
        self.picked(|part, link| match link {
            None => {
                let six = self.by.jacobian(self.arm, self.at);
                six[3 * part..3 * part + 3].to_vec()
            }
            Some(link) => {
                let columns = columns(self.arm, self.at, link);
                matrix(3, columns.len(), |r, j| columns[j][part][r].clone())
            }
        })
    }

    /// Returns J̇ q̇ in the axes of J′.
    pub fn rate(&self, qd: &[S]) -> Vec<S> {
        self.picked(|part, link| {
            let rate = match link {
                None => self.by.jacobian_rate(self.arm, self.at, qd),
                Some(link) => acceleration(self.arm, self.at, qd, link),
            };
            rate[part].to_vec()
        })
    }

    fn picked<T: Clone>(&self, part: impl Fn(usize, Option<usize>) -> Vec<T>) -> Vec<T> {
        let parts = [0, 1].map(|index| part(index, self.links[index]));
        self.arm.frames.rows.pick(&parts.concat())
    }

    fn turn(&self) -> Matrix<S> {
        let (arm, at) = self.arm.to_hand(self.at);
        let poses = poses(&arm, &at);
        let rows: Vec<usize> = self.arm.frames.rows.indices().collect();
        let entry = |r: usize, c: usize| match self.links[r / 3] {
            Some(link) if r / 3 == c / 3 => poses[link - 1].axes[c % 3][r % 3].clone(),
            _ if r == c => S::one(),
            _ => S::zero(),
        };
        matrix(rows.len(), rows.len(), |i, k| entry(rows[i], rows[k]))
    }

    /// Returns G x of each x, a row each.
    pub fn turned(&self, rows: &[Vec<S>]) -> Matrix<S> {
        let turn = self.turn();
        rows.iter().map(|row| products(&turn, row)).collect()
    }

    /// Returns G M Gᵀ of a symmetric M.
    pub fn turned_matrix(&self, matrix: &[Vec<S>]) -> Matrix<S> {
        // M Gᵀ, row by row: its columns are those of G M.
        let half = self.turned(matrix);
        let turn = self.turn();
        let columns = columns_of(&half);
        symmetric(half.len(), |i, k| product(&turn[i], &columns[k]))
    }
}

/// In the axes of a link's frame before the hand's; linear, then angular.
fn columns<S: Scalar>(arm: &Arm<S>, at: &At<S>, link: usize) -> Vec<[Vector<S>; 2]> {
    let (n, way) = (at.len(), arm.way_to_hand());
    let (arm, at) = arm.to_hand(at);
    let at = &*at;
    let mut outer = arm.clone().into_owned();
    outer.base = None;
    outer.links.drain(..link);
    let levers = levers(&outer, &at[link..]);
    let mut hands = alloc::vec![levers[0].origin.clone()];
    for step in arm.steps(at).take(link).rev() {
        let lever = step.lever();
        let turned = step.to_previous(&hands[hands.len() - 1]);
        hands.push(sum(&lever, &turned));
    }
    hands.reverse();
    let mut columns: Vec<[Vector<S>; 2]> = Vec::with_capacity(n);
    for (i, step) in arm.steps(at).take(link).enumerate() {
        let column = |hand: &Vector<S>| match step.link.kind {
            JointKind::Revolute => [z_across(hand), unit_z()],
            JointKind::Prismatic => [unit_z(), zero_vector()],
        };
        if arm.convention == Convention::Standard {
            columns.push(column(&hands[i]));
        }
        for part in columns.iter_mut().flatten() {
            *part = step.to_link(part);
        }
        if arm.convention == Convention::Modified {
            columns.push(column(&hands[i + 1]));
        }
    }
    columns.extend((0..outer.links.len()).map(|joint| by_lever(&outer, &levers, joint)));
    let nothing = alloc::vec![[zero_vector(), zero_vector()]; n];
    placed(nothing, &way, columns)
}

fn acceleration<S: Scalar>(arm: &Arm<S>, at: &At<S>, qd: &[S], link: usize) -> [Vector<S>; 2] {
    let qd = &picked(qd, &arm.way_to_hand())[..];
    let (arm, at) = arm.to_hand(at);
    let at = &*at;
    let mut inner = arm.weightless();
    let mut outer = inner.clone();
    inner.links.truncate(link);
    outer.links.drain(..link);
    let rest = zeros(at.len());
    let rest = arm.accelerations(qd, &rest);
    let base = table2::last_motion(&inner, at, qd, &rest);
    table1::tip_acceleration(&outer, &at[link..], [&qd[link..], &rest[link..]], &base)
}
