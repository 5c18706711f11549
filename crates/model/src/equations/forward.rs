//! Forward dynamics and what belongs to it, of every formulation: closed forms
//! factorise D, the recursions run outward and inward over articulated bodies.

use alloc::vec::Vec;

use super::arm::Posed;
use super::articulated;
use super::derivatives::{columns, with_rates};
use super::energy::moving;
use super::factor::{Factor, placed, scatter, submatrix};
use super::following::{gathered, gathered_columns, gathered_square, spread};
use super::matrix::*;
use super::{Arm, At, Formulation, Link};
use crate::scalar::dual::Dual;
use crate::scalar::{Divide, Scalar};

/// Returns the joints that move, zero-based.
pub fn free(moves: &[bool]) -> Vec<usize> {
    let joints = moves.iter().enumerate();
    joints.filter_map(|(i, moves)| moves.then_some(i)).collect()
}

/// Returns D q̈ = τ − (h + c + b∘q̇) over the joints that move, solved for q̈.
pub fn solved<S: Divide>(d: &[Vec<S>], bias: &[S], tau: &[S], moves: &[bool]) -> Vec<S> {
    let free = free(moves);
    let load: Vec<S> = free.iter().map(|&i| minus(&tau[i], &bias[i])).collect();
    let accelerations = Factor::new(&submatrix(d, &free)).solve(&load);
    scatter(&accelerations, &free, moves.len())
}

/// Returns D⁻¹ over the joints that move; zero in the rows and columns of the others.
pub fn inverted<S: Divide>(d: &[Vec<S>], moves: &[bool]) -> Matrix<S> {
    let (free, n) = (free(moves), moves.len());
    let inverse = Factor::new(&submatrix(d, &free)).inverse();
    let rows = inverse.iter().map(|row| scatter(row, &free, n));
    placed(zero_matrix(n), &free, rows)
}

/// Makes the columns of joints that do not move zero.
pub(crate) fn hold<S: Scalar>(matrix: &mut [Vec<S>], moves: &[bool]) {
    for row in matrix {
        for (entry, _) in row.iter_mut().zip(moves).filter(|(_, moves)| !**moves) {
            *entry = S::zero();
        }
    }
}

/// Returns −D⁻¹ times the slopes of the torques: those of q̈.
pub fn against<S: Scalar>(inverse: &[Vec<S>], slopes: &[Vec<S>]) -> Matrix<S> {
    let columns = columns_of(slopes);
    let entry = |i: usize, k: usize| negative(&product(&inverse[i], &columns[k]));
    matrix(inverse.len(), columns.len(), entry)
}

/// For each joint the torque of Coulomb friction and its slope by the velocity.
fn rubbed<S: Scalar>(arm: &Arm<S>, qd: &[S]) -> Vec<[S; 2]> {
    let rub = |(link, qd): (&Link<S>, &S)| match &link.friction.coulomb {
        None => [S::zero(), S::zero()],
        Some(coulomb) => [coulomb.torque(qd), coulomb.slope()],
    };
    arm.links.iter().zip(qd).map(rub).collect()
}

impl Formulation {
    /// Returns Sᵀ D S, n×n: D gathered at the leaders of joints that follow.
    pub fn gathered_inertia<S: Scalar>(self, arm: &Arm<S>, at: &At<S>) -> Matrix<S> {
        gathered_square(&arm.following, self.inertia(arm, at))
    }

    /// Returns q̈ of the joints that move under τ, zero of the others, which are held or follow.
    pub fn forward_dynamics<S: Divide>(
        self,
        arm: &Arm<S>,
        at: &At<S>,
        qd: &[S],
        tau: &[S],
        moves: &[bool],
    ) -> Vec<S> {
        if !self.has_closed_form() && arm.following.is_empty() {
            let qdd = articulated::forward_dynamics(arm, at, [qd, tau], moves);
            return arm.coordinate_rates(qd, qdd);
        }
        let d = self.gathered_inertia(arm, at);
        let bias = self.inverse_dynamics(arm, at, qd, &zeros(qd.len()));
        let [bias, tau] = [bias, tau.to_vec()].map(|loads| gathered(&arm.following, loads));
        solved(&d, &bias, &tau, moves)
    }

    /// Returns D⁻¹ over the joints that move, zero of the others. A recursion gives its columns as
    /// the accelerations under unit torques, at rest and without weight.
    pub fn inertia_inverse<S: Divide>(self, arm: &Arm<S>, at: &At<S>, moves: &[bool]) -> Matrix<S> {
        if self.has_closed_form() || !arm.following.is_empty() {
            return inverted(&self.gathered_inertia(arm, at), moves);
        }
        let n = at.len();
        let arm = arm.weightless().without_friction();
        let row = |k: usize| {
            let tau = if moves[k] { unit(n, k) } else { zeros(n) };
            articulated::forward_dynamics(&arm, at, [&zeros(n), &tau], moves)
        };
        // Symmetric: its columns are its rows.
        (0..n).map(row).collect()
    }

    /// Returns ∂q̈/∂q and ∂q̈/∂q̇: closed forms from slopes of τ at that q̈, recursions by duals.
    pub fn acceleration_slopes<S: Divide>(
        self,
        arm: &Arm<S>,
        at: &At<S>,
        qd: &[S],
        tau: &[S],
        moves: &[bool],
    ) -> [Matrix<S>; 2] {
        if self.has_closed_form() || !arm.following.is_empty() {
            let inverse = self.inertia_inverse(arm, at, moves);
            let qdd = self.forward_dynamics(arm, at, qd, tau, moves);
            let qdd = spread(&arm.following, qdd);
            let by_position = self.torque_by_position(arm, at, qd, &qdd);
            let by_velocity = self.torque_by_velocity(arm, at, qd);
            return [by_position, by_velocity]
                .map(|slopes| against(&inverse, &gathered_columns(&arm.following, slopes)));
        }
        let n = at.len();
        let rubbed = rubbed(arm, qd);
        let run = |(mut arm, at): Posed<Dual<S>>, growth: &[S]| {
            for link in &mut arm.links {
                link.friction.coulomb = None;
            }
            let grown = with_rates(qd, growth);
            // Coulomb friction reduces the torques by its value, and their rates by its own slope.
            let loads = tau.iter().zip(&rubbed).zip(growth);
            let rest = loads.map(|((tau, [torque, slope]), growth)| Dual {
                value: minus(tau, torque),
                rate: negative(&times(slope, growth)),
            });
            let left: Vec<Dual<S>> = rest.collect();
            let qdd = articulated::forward_dynamics(&arm, &at, [&grown, &left], moves);
            arm.coordinate_rates(&grown, qdd)
        };
        let rest: Vec<S> = zeros(n);
        [
            columns(n, &|k| run(arm.displaced(at, k), &rest)),
            columns(n, &|k| run(moving(arm, at, &rest), &unit(n, k))),
        ]
    }
}
