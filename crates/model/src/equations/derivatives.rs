//! Derivatives of the torques, of every formulation, by duals: the formula's
//! own text over a value and its rate of change.

use alloc::vec::Vec;

use super::energy::moving;
use super::matrix::{columns_of, plus, twice, unit};
use super::{Arm, DhVariables, Formulation};
use crate::scalar::Scalar;
use crate::scalar::dual::Dual;

impl Formulation {
    /// Returns ∂τ/∂q, n×n: row i has the slopes of τ_i, joint by joint as it moves at a unit rate.
    pub fn torque_by_position<S: Scalar>(
        self,
        arm: &Arm<S>,
        at: &[DhVariables<S>],
        qd: &[S],
        qdd: &[S],
    ) -> Vec<Vec<S>> {
        let [qd, qdd] = [qd, qdd].map(|rates| constants(rates));
        columns(at.len(), &|joint| {
            let (arm, at) = moving(arm, at, &unit(at.len(), joint));
            self.inverse_dynamics(&arm, &at, &qd, &qdd)
        })
    }

    /// Returns ∂τ/∂q̇, n×n, what friction grows by on its diagonal: joint by joint as its velocity
    /// grows at a unit rate. What q̈ and gravity add to the torques does not depend on q̇ and is
    /// left out. Lagrange–Euler has it from the symbols: Σ_m (h_ikm + h_imk) q̇_m = 2 C_ik.
    pub fn torque_by_velocity<S: Scalar>(
        self,
        arm: &Arm<S>,
        at: &[DhVariables<S>],
        qd: &[S],
    ) -> Vec<Vec<S>> {
        let is_doubled = self == Self::LagrangeEuler;
        let mut rows = if is_doubled {
            self.coriolis_matrix(arm, at, qd)
        } else {
            let still = |x: &S| Dual::constant(x.clone());
            let still_arm = arm.map(still);
            let at = at.iter().map(|at| DhVariables {
                theta: at.theta.map(still),
                d: still(&at.d),
            });
            let at: Vec<_> = at.collect();
            columns(at.len(), &|joint| {
                let mut qd = constants(qd);
                qd[joint].rate = S::one();
                self.velocity_terms(&still_arm, &at, &qd)
            })
        };
        for (i, (row, link)) in rows.iter_mut().zip(&arm.links).enumerate() {
            if is_doubled {
                row.iter_mut().for_each(|c| *c = twice(c));
            }
            row[i] = plus(&row[i], &link.friction.slope());
        }
        rows
    }
}

pub(super) fn constants<S: Scalar>(values: &[S]) -> Vec<Dual<S>> {
    values.iter().cloned().map(Dual::constant).collect()
}

pub(super) fn with_rates<S: Scalar>(values: &[S], rates: &[S]) -> Vec<Dual<S>> {
    let pairs = values.iter().cloned().zip(rates.iter().cloned());
    pairs.map(|(value, rate)| Dual { value, rate }).collect()
}

pub(super) fn columns<S: Scalar>(n: usize, column: &dyn Fn(usize) -> Vec<Dual<S>>) -> Vec<Vec<S>> {
    let rates = |k: usize| column(k).into_iter().map(|x| x.rate).collect();
    columns_of(&(0..n).map(rates).collect::<Vec<Vec<S>>>())
}
