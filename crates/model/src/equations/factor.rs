//! D = U diag(d) Uᵀ and what follows from it: q̈ and D⁻¹.
//!
//! Joints are eliminated from the hand inward, so that d_k is what joint k alone would have to
//! accelerate if all joints beyond it were free: the inertia of its articulated body. It divides,
//! and may: a positive definite D has positive pivots in every order. A pivot of the arm's own that
//! is a constant, and entries of D that vanish, stay so as far as elimination leaves them, which is
//! further from this end than from the other.

use alloc::vec::Vec;

use super::matrix::*;
use crate::scalar::{Divide, Scalar};

/// The factors of a symmetric matrix, of which all unknowns but the first few are eliminated.
#[derive(Clone, Debug)]
pub struct Factor<S> {
    /// d_k on the diagonal; of the unknowns that are left, the lower half of their matrix.
    rest: Matrix<S>,
    /// `upper[k][i]` = U_ik, i < k, of those that are eliminated.
    upper: Matrix<S>,
    /// 1/d_k of those.
    inverses: Vec<S>,
    kept: usize,
}

impl<S: Divide> Factor<S> {
    /// Factors a symmetric matrix, whose upper half is not read, by n − 1 divisions at most.
    pub fn new(matrix: &[Vec<S>]) -> Factor<S> {
        Factor::partial(matrix, 0)
    }

    /// Eliminates all unknowns but the first `kept`; the upper half of the matrix is not read.
    pub(super) fn partial(matrix: &[Vec<S>], kept: usize) -> Factor<S> {
        let mut rest: Matrix<S> = matrix.to_vec();
        let (mut upper, mut inverses) = (Vec::new(), Vec::new());
        for k in (kept..matrix.len()).rev() {
            let row: Vec<S> = rest[k][..k].to_vec();
            let inverse = over(&S::one(), &rest[k][k]);
            let factors: Vec<S> = row.iter().map(|x| times(x, &inverse)).collect();
            for (i, factor) in factors.iter().enumerate() {
                for (entry, other) in rest[i][..=i].iter_mut().zip(&row) {
                    *entry = minus(entry, &times(factor, other));
                }
            }
            upper.push(factors);
            inverses.push(inverse);
        }
        upper.reverse();
        inverses.reverse();
        Factor {
            rest,
            upper,
            inverses,
            kept,
        }
    }

    /// Returns d
    pub fn pivots(&self) -> Vec<S> {
        let pivot = |k: usize| self.rest[k][k].clone();
        (self.kept..self.rest.len()).map(pivot).collect()
    }

    /// Returns entry (i, k) of the matrix that is left of the first unknowns, k ≤ i.
    pub(super) fn left(&self, i: usize, k: usize) -> &S {
        &self.rest[i][k]
    }

    /// Returns x with D x = b.
    pub fn solve(&self, b: &[S]) -> Vec<S> {
        self.substituted(self.eliminate(b, |k, x| match k {
            0 => over(x, &self.rest[0][0]),
            _ => times(x, &self.inverses[k]),
        }))
    }

    /// Returns U⁻¹ b
    pub fn eliminated(&self, b: &[S]) -> Vec<S> {
        self.eliminate(b, |_, x| x.clone())
    }

    /// Returns U⁻¹ Aᵀ over these joints, a row for each of A's.
    pub(super) fn eliminated_rows(&self, rows: &[Vec<S>], joints: &[usize]) -> Matrix<S> {
        let of_joints = rows.iter().map(|row| picked(row, joints));
        of_joints.map(|row| self.eliminated(&row)).collect()
    }

    /// Returns b of the first unknowns, the others eliminated, then these if the first vanish.
    pub(super) fn halfway(&self, b: &[S]) -> Vec<S> {
        self.eliminate(b, |k, x| times(x, &self.inverses[k]))
    }

    /// Returns diag(1/d) x
    pub fn scaled(&self, x: &[S]) -> Vec<S> {
        let pairs = x.iter().zip(&self.inverses);
        pairs.map(|(x, inverse)| times(x, inverse)).collect()
    }

    /// Returns U⁻ᵀ x
    pub fn substituted(&self, mut x: Vec<S>) -> Vec<S> {
        for (k, factors) in self.upper.iter().enumerate() {
            let (before, tail) = x.split_at_mut(self.kept + k);
            for (x, factor) in before.iter().zip(factors) {
                tail[0] = minus(&tail[0], &times(factor, x));
            }
        }
        x
    }

    fn eliminate(&self, b: &[S], then: impl Fn(usize, &S) -> S) -> Vec<S> {
        let mut x = b.to_vec();
        for (k, factors) in self.upper.iter().enumerate().rev() {
            let (before, tail) = x.split_at_mut(self.kept + k);
            for (x, factor) in before.iter_mut().zip(factors) {
                *x = minus(x, &times(factor, &tail[0]));
            }
            tail[0] = then(k, &tail[0]);
        }
        x
    }

    /// Returns D⁻¹ = U⁻ᵀ diag(1/d) U⁻¹, n×n, symmetric.
    pub fn inverse(&self) -> Matrix<S> {
        let n = self.upper.len();
        // [k][i] = (U⁻¹)_ik, i ≤ k: U U⁻¹ = 1 column by column.
        let mut inverse: Matrix<S> = Vec::with_capacity(n);
        for k in 0..n {
            let mut column = alloc::vec![S::zero(); k];
            column.push(S::one());
            for i in (0..k).rev() {
                let mut entry = negative(&self.upper[k][i]);
                for (l, factor) in column.iter().enumerate().take(k).skip(i + 1) {
                    entry = minus(&entry, &times(&self.upper[l][i], factor));
                }
                column[i] = entry;
            }
            inverse.push(column);
        }
        let scaled: Matrix<S> = inverse.iter().map(|column| self.scaled(column)).collect();
        symmetric(n, |i, k| product(&scaled[i], &inverse[k]))
    }
}

/// Returns the values of these joints alone.
pub(crate) fn picked<T: Clone>(values: &[T], joints: &[usize]) -> Vec<T> {
    joints.iter().map(|&joint| values[joint].clone()).collect()
}

/// Returns a matrix over these joints alone.
pub fn submatrix<S: Scalar>(matrix: &[Vec<S>], joints: &[usize]) -> Matrix<S> {
    joints.iter().map(|&i| picked(&matrix[i], joints)).collect()
}

/// Returns a vector of n entries that has these at these joints, and zeros elsewhere.
pub fn scatter<S: Scalar>(values: &[S], joints: &[usize], n: usize) -> Vec<S> {
    placed(zeros(n), joints, values.iter().cloned())
}

pub(super) fn placed<T>(
    mut entries: Vec<T>,
    joints: &[usize],
    values: impl IntoIterator<Item = T>,
) -> Vec<T> {
    for (&joint, value) in joints.iter().zip(values) {
        entries[joint] = value;
    }
    entries
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::field::{Field, Points};

    #[test]
    fn is_the_inverse() {
        let mut points = Points::new(0xfac);
        for n in 1..=7 {
            let entries: Vec<Field> = (0..n * n).map(|_| points.field()).collect();
            let matrix = symmetric(n, |i, k| entries[i * n + k]);
            let factor = Factor::new(&matrix);
            let b: Vec<Field> = (0..n).map(|_| points.field()).collect();
            let (x, inverse) = (factor.solve(&b), factor.inverse());
            for i in 0..n {
                assert_eq!(product(&matrix[i], &x), b[i]);
                for (k, column) in inverse.iter().enumerate() {
                    let one = if i == k { Field::ONE } else { Field::ZERO };
                    assert_eq!(product(&matrix[i], column), one);
                }
            }
        }
    }
}
