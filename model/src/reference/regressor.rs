//! Y in τ = Y π in floating point: differences of inverse dynamics.

use alloc::vec::Vec;

use nalgebra::{DMatrix, DVector};

use super::{Float, Reference, WrongLength, torques};
use crate::equations::regressor::{Column, differences, of_links};

impl<T: Float> Reference<T> {
    /// Y, a row a joint: what each of these columns takes of torque.
    pub fn regressor(
        &self,
        q: &DVector<T>,
        qd: &DVector<T>,
        qdd: &DVector<T>,
        columns: &[Column<T>],
    ) -> Result<DMatrix<T>, WrongLength> {
        let at = self.at(q)?;
        let [qd, qdd] = [self.values("qd", qd)?, self.values("qdd", qdd)?];
        let rows: Vec<Vec<T>> = differences(&self.arm, columns, qd, qdd, |arm| {
            torques(arm, &at, qd, qdd)
        });
        let entry = |i: usize, k: usize| rows[i][k];
        Ok(DMatrix::from_fn(rows.len(), columns.len(), entry))
    }

    /// Y over all inertial parameters of all links, n×10n: m, m x, m y, m z, Ixx,
    /// Iyy, Izz, Ixy, Iyz and Ixz of each link, about the origin and in the axes
    /// of its DH frame.
    pub fn full_regressor(
        &self,
        q: &DVector<T>,
        qd: &DVector<T>,
        qdd: &DVector<T>,
    ) -> Result<DMatrix<T>, WrongLength> {
        self.regressor(q, qd, qdd, &of_links(self.joints()))
    }
}
