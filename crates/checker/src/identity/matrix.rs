//! Vectors and matrices of residues.

use super::number::Number;

/// A matrix by rows.
pub(super) type Matrix = Vec<Vec<Number>>;

pub(super) fn product(a: &[Number], b: &[Number]) -> Number {
    let products = a.iter().zip(b).map(|(a, b)| *a * *b);
    products.fold(0.into(), |a, b| a + b)
}

pub(super) fn plus(a: &[Number], b: &[Number]) -> Vec<Number> {
    a.iter().zip(b).map(|(a, b)| *a + *b).collect()
}

pub(super) fn minus(a: &[Number], b: &[Number]) -> Vec<Number> {
    a.iter().zip(b).map(|(a, b)| *a - *b).collect()
}

pub(super) fn times(matrix: &Matrix, x: &[Number]) -> Vec<Number> {
    matrix.iter().map(|row| product(row, x)).collect()
}

pub(super) fn units(n: usize) -> Matrix {
    let row = |i: usize| (0..n).map(|k| i64::from(i == k).into()).collect();
    (0..n).map(row).collect()
}

pub(super) fn transposed(matrix: &Matrix) -> Matrix {
    let length = matrix.first().map_or(0, Vec::len);
    let column = |k: usize| matrix.iter().map(|row| row[k]).collect();
    (0..length).map(column).collect()
}

/// Returns M⁻¹ x of each x, by Gauss: M is symmetric, and no pivot is zero but by chance.
pub(super) fn solve(mut m: Matrix, mut right: Matrix) -> Matrix {
    let n = m.len();
    for k in 0..n {
        for i in k + 1..n {
            let factor = m[i][k] / m[k][k];
            let pivot = m[k].clone();
            let both = m[i].iter_mut().zip(&pivot).skip(k);
            both.for_each(|(entry, above)| *entry = *entry - factor * *above);
            right.iter_mut().for_each(|x| x[i] = x[i] - factor * x[k]);
        }
    }
    for x in &mut right {
        for k in (0..n).rev() {
            let known = product(&m[k][k + 1..], &x[k + 1..]);
            x[k] = (x[k] - known) / m[k][k];
        }
    }
    right
}
