//! Derivatives of the torques, of every formulation, by duals: the formula's
//! own text over a value and its rate of change.

use alloc::vec::Vec;

use super::energy::moving;
use super::matrix::{plus, twice, zeros};
use super::{Arm, DhVariables, Formulation};
use crate::scalar::Scalar;
use crate::scalar::dual::Dual;

impl Formulation {
    /// Returns ∂τ/∂q, n×n: row i has the slopes of τ_i.
    pub fn torque_by_position<S: Scalar>(
        self,
        arm: &Arm<S>,
        at: &[DhVariables<S>],
        qd: &[S],
        qdd: &[S],
    ) -> Vec<Vec<S>> {
        by_position(
            |arm, at, qd, qdd| self.inverse_dynamics(arm, at, qd, qdd),
            arm,
            at,
            qd,
            qdd,
        )
    }

    /// Returns ∂τ/∂q̇, n×n, what friction grows by on its diagonal. What q̈ and gravity add to the
    /// torques does not depend on q̇ and is left out. Lagrange–Euler has it from
    /// the symbols: Σ_m (h_ikm + h_imk) q̇_m = 2 C_ik.
    pub fn torque_by_velocity<S: Scalar>(
        self,
        arm: &Arm<S>,
        at: &[DhVariables<S>],
        qd: &[S],
    ) -> Vec<Vec<S>> {
        if self == Self::LagrangeEuler {
            let mut rows = self.coriolis_matrix(arm, at, qd);
            for (i, (row, link)) in rows.iter_mut().zip(&arm.links).enumerate() {
                row.iter_mut().for_each(|c| *c = twice(c));
                row[i] = plus(&row[i], &link.friction.slope());
            }
            return rows;
        }
        by_velocity(|arm, at, qd| self.velocity_terms(arm, at, qd), arm, at, qd)
    }
}

/// Returns ∂τ/∂q of any τ(q, q̇, q̈): joint by joint as it moves at a unit rate.
pub fn by_position<S: Scalar>(
    torques: impl Fn(&Arm<Dual<S>>, &[DhVariables<Dual<S>>], &[Dual<S>], &[Dual<S>]) -> Vec<Dual<S>>,
    arm: &Arm<S>,
    at: &[DhVariables<S>],
    qd: &[S],
    qdd: &[S],
) -> Vec<Vec<S>> {
    let [qd, qdd] = [qd, qdd].map(|rates| constants(rates));
    columns(at.len(), |joint| {
        let mut rates = zeros(at.len());
        rates[joint] = S::one();
        let (arm, at) = moving(arm, at, &rates);
        torques(&arm, &at, &qd, &qdd)
    })
}

/// Returns ∂(h + (b + F∘r)∘q̇)/∂q̇ of any h(q, q̇): joint by joint as its velocity grows at a
/// unit rate.
pub fn by_velocity<S: Scalar>(
    velocity_terms: impl Fn(&Arm<Dual<S>>, &[DhVariables<Dual<S>>], &[Dual<S>]) -> Vec<Dual<S>>,
    arm: &Arm<S>,
    at: &[DhVariables<S>],
    qd: &[S],
) -> Vec<Vec<S>> {
    let still = |x: &S| Dual::constant(x.clone());
    let moving_arm = arm.map(still);
    let at: Vec<_> = at
        .iter()
        .map(|at| DhVariables {
            theta: at.theta.map(still),
            d: still(&at.d),
        })
        .collect();
    let mut rows = columns(at.len(), |joint| {
        let mut qd = constants(qd);
        qd[joint].rate = S::one();
        velocity_terms(&moving_arm, &at, &qd)
    });
    for (i, link) in arm.links.iter().enumerate() {
        rows[i][i] = plus(&rows[i][i], &link.friction.slope());
    }
    rows
}

fn constants<S: Scalar>(values: &[S]) -> Vec<Dual<S>> {
    values.iter().cloned().map(Dual::constant).collect()
}

/// Returns the rates of change of columns, row by row.
pub(super) fn columns<S: Scalar>(n: usize, column: impl Fn(usize) -> Vec<Dual<S>>) -> Vec<Vec<S>> {
    let columns: Vec<Vec<Dual<S>>> = (0..n).map(column).collect();
    let row = |i: usize| {
        columns
            .iter()
            .map(|column| column[i].rate.clone())
            .collect()
    };
    (0..n).map(row).collect()
}
