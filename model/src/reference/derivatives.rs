//! Slopes of the torques in floating point, duals through the recursion, and
//! its bilinear form.

use alloc::vec::Vec;

use nalgebra::{DMatrix, DVector};

use super::{Float, Reference, WrongLength, matrix, torques};
use crate::equations::{derivatives, from_torques};

impl<T: Float> Reference<T> {
    /// ∂τ/∂q, n×n: row i has the slopes of τ_i.
    pub fn torque_by_position(
        &self,
        q: &DVector<T>,
        qd: &DVector<T>,
        qdd: &DVector<T>,
    ) -> Result<DMatrix<T>, WrongLength> {
        let at = self.at(q)?;
        let [qd, qdd] = [self.values("qd", qd)?, self.values("qdd", qdd)?];
        let rows = derivatives::by_position(torques, &self.arm, &at, qd, qdd);
        Ok(matrix(&rows))
    }

    /// ∂τ/∂q̇, n×n, what friction grows by on its diagonal.
    pub fn torque_by_velocity(
        &self,
        q: &DVector<T>,
        qd: &DVector<T>,
    ) -> Result<DMatrix<T>, WrongLength> {
        let at = self.at(q)?;
        let qd = self.values("qd", qd)?;
        let h = |arm: &_, at: &[_], qd: &[_]| -> Vec<_> {
            from_torques::velocity_terms(torques, arm, at, qd)
        };
        Ok(matrix(&derivatives::by_velocity(
            h,
            &self.arm_at(qd),
            &at,
            qd,
        )))
    }

    /// D a + C v + c + (b + F∘r)∘v, r of q̇, with C of the Christoffel symbols.
    pub fn passivity(
        &self,
        q: &DVector<T>,
        qd: &DVector<T>,
        v: &DVector<T>,
        a: &DVector<T>,
    ) -> Result<DVector<T>, WrongLength> {
        let at = self.at(q)?;
        let qd = self.values("qd", qd)?;
        let [v, a] = [self.values("v", v)?, self.values("a", a)?];
        let mut tau = from_torques::passivity(torques, &self.arm, &at, qd, [v, a]);
        for ((tau, link), v) in tau.iter_mut().zip(&self.arm_at(qd).links).zip(v) {
            *tau = tau.add(&link.friction.torque(v));
        }
        Ok(DVector::from_vec(tau))
    }
}
