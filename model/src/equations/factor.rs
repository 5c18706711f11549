//! D = U diag(d) Uᵀ and what follows from it: q̈ and D⁻¹.
//!
//! Joints are eliminated from the hand inward, so that d_k is what joint k
//! alone would have to accelerate if all joints beyond it were free: the
//! inertia of its articulated body. It divides, and may: a positive definite D
//! has positive pivots in every order. A pivot of the arm's own that is a
//! constant, and entries of D that vanish, stay so as far as elimination
//! leaves them, which is further from this end than from the other.

use alloc::vec::Vec;

use super::matrix::{minus, negative, over, plus, symmetric, times};
use crate::scalar::{Divide, Scalar};

/// The factors of a symmetric matrix.
#[derive(Clone, Debug)]
pub struct Factor<S> {
    /// `upper[k][i]` = U_ik, i < k.
    upper: Vec<Vec<S>>,
    /// d_k
    pivots: Vec<S>,
    /// 1/d_k
    inverses: Vec<S>,
}

/// A symmetric matrix of which all unknowns but the first few are eliminated.
#[derive(Clone, Debug)]
pub struct Partial<S> {
    /// The rest of the matrix; of the first unknowns, the lower half.
    rest: Vec<Vec<S>>,
    /// `upper[k][i]` = U_ik, i < k, of those that are eliminated.
    upper: Vec<Vec<S>>,
    /// 1/d_k of those.
    inverses: Vec<S>,
    /// The number of unknowns that are left.
    kept: usize,
}

impl<S: Divide> Partial<S> {
    /// Eliminates from a symmetric matrix, whose upper half is not read, all unknowns but the
    /// first. A division for each pivot that an entry above it is divided by.
    pub fn new(matrix: &[Vec<S>], kept: usize) -> Partial<S> {
        let mut rest: Vec<Vec<S>> = matrix.to_vec();
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
        Partial {
            rest,
            upper,
            inverses,
            kept,
        }
    }

    /// Returns entry (i, k) of the matrix that is left of the first unknowns, k ≤ i.
    pub fn left(&self, i: usize, k: usize) -> &S {
        &self.rest[i][k]
    }

    /// Returns the right side b of the first unknowns once the others are eliminated, then what
    /// these are if the first vanish.
    pub fn eliminated(&self, b: &[S]) -> Vec<S> {
        let mut x = b.to_vec();
        for (k, factors) in self.upper.iter().enumerate().rev() {
            let (before, own) = x.split_at_mut(self.kept + k);
            for (x, factor) in before.iter_mut().zip(factors) {
                *x = minus(x, &times(factor, &own[0]));
            }
            own[0] = times(&own[0], &self.inverses[k]);
        }
        x
    }

    /// Returns all unknowns, of which the first are given.
    pub fn substituted(&self, mut x: Vec<S>) -> Vec<S> {
        for (k, factors) in self.upper.iter().enumerate() {
            let (before, own) = x.split_at_mut(self.kept + k);
            for (x, factor) in before.iter().zip(factors) {
                own[0] = minus(&own[0], &times(factor, x));
            }
        }
        x
    }
}

impl<S: Divide> Factor<S> {
    /// Factors a symmetric matrix, whose upper half is not read. A division for
    /// each pivot that an entry above it is divided by; n − 1 at most.
    pub fn new(matrix: &[Vec<S>]) -> Factor<S> {
        let Partial {
            rest,
            upper,
            inverses,
            ..
        } = Partial::new(matrix, 0);
        Factor {
            upper,
            pivots: (0..rest.len()).map(|k| rest[k][k].clone()).collect(),
            inverses,
        }
    }

    /// Returns d
    pub fn pivots(&self) -> &[S] {
        &self.pivots
    }

    /// Returns x with D x = b.
    pub fn solve(&self, b: &[S]) -> Vec<S> {
        self.substituted(self.eliminate(b, |k, x| match k {
            0 => over(x, &self.pivots[0]),
            _ => times(x, &self.inverses[k]),
        }))
    }

    /// Returns U⁻¹ b
    pub fn eliminated(&self, b: &[S]) -> Vec<S> {
        self.eliminate(b, |_, x| x.clone())
    }

    /// Returns diag(1/d) x
    pub fn scaled(&self, x: &[S]) -> Vec<S> {
        let pairs = x.iter().zip(&self.inverses);
        pairs.map(|(x, inverse)| times(x, inverse)).collect()
    }

    /// Returns U⁻ᵀ x
    pub fn substituted(&self, mut x: Vec<S>) -> Vec<S> {
        for k in 1..x.len() {
            for i in 0..k {
                x[k] = minus(&x[k], &times(&self.upper[k][i], &x[i]));
            }
        }
        x
    }

    /// Returns U⁻¹ b, each entry through `then` once it has been eliminated from the others.
    fn eliminate(&self, b: &[S], then: impl Fn(usize, &S) -> S) -> Vec<S> {
        let mut x = b.to_vec();
        for k in (0..x.len()).rev() {
            for i in 0..k {
                x[i] = minus(&x[i], &times(&self.upper[k][i], &x[k]));
            }
            x[k] = then(k, &x[k]);
        }
        x
    }

    /// Returns D⁻¹ = U⁻ᵀ diag(1/d) U⁻¹, n×n, symmetric.
    pub fn inverse(&self) -> Vec<Vec<S>> {
        let n = self.pivots.len();
        // [k][i] = (U⁻¹)_ik, i ≤ k: U U⁻¹ = 1 column by column.
        let mut inverse: Vec<Vec<S>> = Vec::with_capacity(n);
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
        let scaled: Vec<Vec<S>> = inverse.iter().map(|column| self.scaled(column)).collect();
        symmetric(n, |i, k| {
            (0..=k).fold(S::zero(), |sum, l| {
                plus(&sum, &times(&scaled[i][l], &inverse[k][l]))
            })
        })
    }
}

/// Returns a matrix over these joints alone.
pub fn submatrix<S: Scalar>(matrix: &[Vec<S>], joints: &[usize]) -> Vec<Vec<S>> {
    let row = |&i: &usize| joints.iter().map(|&k| matrix[i][k].clone()).collect();
    joints.iter().map(row).collect()
}

/// Returns a vector of n entries that has these at these joints, and zeros elsewhere.
pub fn scatter<S: Scalar>(values: &[S], joints: &[usize], n: usize) -> Vec<S> {
    let mut all = alloc::vec![S::zero(); n];
    for (value, &joint) in values.iter().zip(joints) {
        all[joint] = value.clone();
    }
    all
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
            let dot = |a: &[Field], b: &[Field]| {
                let products = a.iter().zip(b).map(|(a, b)| a.mul(b));
                products.fold(Field::ZERO, |sum, product| sum.add(&product))
            };
            for i in 0..n {
                assert_eq!(dot(&matrix[i], &x), b[i]);
                for (k, column) in inverse.iter().enumerate() {
                    let one = if i == k { Field::ONE } else { Field::ZERO };
                    assert_eq!(dot(&matrix[i], column), one);
                }
            }
        }
    }
}
