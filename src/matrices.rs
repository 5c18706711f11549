//! Arrays of generated functions as nalgebra's vectors and matrices, and back.
//!
//! Generated matrices are arrays of rows, nalgebra's are stored by columns:
//! `SMatrix::from(array)` compiles for either, and transposes. These do not.
//!
//! ```
//! use dalembert::matrices::{array, matrix, vector};
//! use nalgebra::{SMatrix, SVector};
//!
//! dalembert::dynamics! {
//!     mod arm = "generated/robots/planar2r.toml";
//!     outputs: inertia, jacobian, gravity;
//! }
//! let q = SVector::<f64, 2>::new(0.3, -0.5);
//! // Arguments without a copy.
//! let load = vector(arm::gravity(array(&q)));
//! let inertia = matrix(arm::inertia(array(&q)));
//! let jacobian: SMatrix<f64, 6, 2> = matrix(arm::jacobian(array(&q)));
//!
//! let wrench = SVector::<f64, 6>::zeros();
//! let tau = inertia * q + load + jacobian.transpose() * wrench;
//! assert_eq!(tau.len(), 2);
//! ```

use nalgebra::{SMatrix, SVector, Scalar};

/// Returns a result that is a vector.
#[inline]
#[must_use]
pub fn vector<T: Scalar, const N: usize>(array: [T; N]) -> SVector<T, N> {
    SVector::from(array)
}

/// Returns a result that is a matrix: its rows become the matrix's rows.
#[inline]
#[must_use]
pub fn matrix<T: Scalar, const R: usize, const C: usize>(rows: [[T; C]; R]) -> SMatrix<T, R, C> {
    SMatrix::from_fn(|row, column| rows[row][column].clone())
}

/// Returns a vector as an argument; nothing is copied.
#[inline]
#[must_use]
pub fn array<T: Scalar, const N: usize>(vector: &SVector<T, N>) -> &[T; N] {
    &vector.data.0[0]
}

/// Returns a matrix as an array of rows.
#[inline]
#[must_use]
pub fn rows<T: Scalar, const R: usize, const C: usize>(matrix: &SMatrix<T, R, C>) -> [[T; C]; R] {
    core::array::from_fn(|row| core::array::from_fn(|column| matrix[(row, column)].clone()))
}
