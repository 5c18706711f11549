//! Y in τ = Y π in floating point: differences of inverse dynamics.

use alloc::vec::Vec;

use nalgebra::{DMatrix, DVector};

use super::{Float, Reference, WrongLength, torques};
use crate::equations::from_torques;
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
        Ok(matrix(&rows, columns.len()))
    }

    /// The same of D a + C v + c + b∘v, with C of the Christoffel symbols.
    pub fn passivity_regressor(
        &self,
        q: &DVector<T>,
        qd: &DVector<T>,
        v: &DVector<T>,
        a: &DVector<T>,
        columns: &[Column<T>],
    ) -> Result<DMatrix<T>, WrongLength> {
        let at = self.at(q)?;
        let qd = self.values("qd", qd)?;
        let [v, a] = [self.values("v", v)?, self.values("a", a)?];
        // An arm of one parameter alone has no damping: that has its own column.
        let rows: Vec<Vec<T>> = differences(&self.arm, columns, v, a, |arm| {
            from_torques::passivity(torques, arm, &at, qd, [v, a])
        });
        Ok(matrix(&rows, columns.len()))
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

fn matrix<T: Float>(rows: &[Vec<T>], columns: usize) -> DMatrix<T> {
    DMatrix::from_fn(rows.len(), columns, |i, k| rows[i][k])
}
