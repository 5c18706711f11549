//! Forward dynamics in floating point, by articulated bodies.

use nalgebra::{DMatrix, DVector};

use super::{Float, Reference, WrongLength, matrix};
use crate::equations::Formulation;

impl<T: Float> Reference<T> {
    /// q̈ = D⁻¹ (τ − h − c − (b + F∘r)∘q̇); infinities and NaN where D is singular.
    pub fn forward_dynamics(
        &self,
        q: &DVector<T>,
        qd: &DVector<T>,
        tau: &DVector<T>,
    ) -> Result<DVector<T>, WrongLength> {
        let at = self.at(q)?;
        let [qd, tau] = [self.values("qd", qd)?, self.values("tau", tau)?];
        let moves = alloc::vec![true; self.joints()];
        let recursion = Formulation::NewtonEulerLink;
        let qdd = recursion.forward_dynamics(&self.arm_at(qd), &at, qd, tau, &moves);
        Ok(DVector::from_vec(qdd))
    }

    /// ∂q̈/∂q and ∂q̈/∂q̇, n×n each: duals through the articulated bodies.
    pub fn acceleration_slopes(
        &self,
        q: &DVector<T>,
        qd: &DVector<T>,
        tau: &DVector<T>,
    ) -> Result<[DMatrix<T>; 2], WrongLength> {
        let at = self.at(q)?;
        let [qd, tau] = [self.values("qd", qd)?, self.values("tau", tau)?];
        let moves = alloc::vec![true; self.joints()];
        let recursion = Formulation::NewtonEulerLink;
        let slopes = recursion.acceleration_slopes(&self.arm_at(qd), &at, qd, tau, &moves);
        Ok(slopes.map(|rows| matrix(&rows)))
    }

    /// D⁻¹, n×n, symmetric.
    pub fn inertia_inverse(&self, q: &DVector<T>) -> Result<DMatrix<T>, WrongLength> {
        let at = self.at(q)?;
        let moves = alloc::vec![true; self.joints()];
        let inverse = Formulation::NewtonEulerLink.inertia_inverse(&self.arm, &at, &moves);
        // Rounding leaves the halves of an exactly symmetric matrix apart.
        let n = inverse.len();
        let mean = |i: usize, k: usize| inverse[i][k].add(&inverse[k][i]).half();
        let rows: alloc::vec::Vec<_> = (0..n)
            .map(|i| (0..n).map(|k| mean(i, k)).collect())
            .collect();
        Ok(matrix(&rows))
    }
}
