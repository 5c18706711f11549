//! The condition of a symmetric positive semidefinite matrix.

/// `d` is row by row. Infinite where the least eigenvalue is not positive.
pub(crate) fn condition(d: &[f64]) -> f64 {
    ratio(rows(d))
}

/// For D_ik / √(D_ii D_kk), from which units and sizes of the joints are taken out.
pub(crate) fn scaled_condition(d: &[f64]) -> f64 {
    let matrix = rows(d);
    let entry = |i: usize, k: usize| match (matrix[i][i] * matrix[k][k]).sqrt() {
        size if size > 0.0 => matrix[i][k] / size,
        _ => 0.0,
    };
    let n = matrix.len();
    let row = |i| (0..n).map(|k| entry(i, k)).collect();
    ratio((0..n).map(row).collect())
}

fn rows(d: &[f64]) -> Vec<Vec<f64>> {
    let n = d.len().isqrt();
    d.chunks(n.max(1)).map(<[f64]>::to_vec).collect()
}

fn ratio(matrix: Vec<Vec<f64>>) -> f64 {
    let values = eigenvalues(matrix);
    let largest = values.iter().copied().fold(0.0, f64::max);
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    match least > 0.0 {
        true => largest / least,
        false => f64::INFINITY,
    }
}

/// Jacobi's rotations find small eigenvalues of a matrix with a unit diagonal to relative accuracy.
fn eigenvalues(mut m: Vec<Vec<f64>>) -> Vec<f64> {
    let n = m.len();
    for _ in 0..30 {
        let mut changed = false;
        for p in 0..n {
            for q in p + 1..n {
                let off = m[p][q];
                let size = (m[p][p] * m[q][q]).abs().sqrt();
                if off == 0.0 || off.abs() <= f64::EPSILON * size {
                    continue;
                }
                changed = true;
                let theta = (m[q][q] - m[p][p]) / (2.0 * off);
                let t = theta.signum() / (theta.abs() + theta.hypot(1.0));
                let c = 1.0 / t.hypot(1.0);
                rotate(&mut m, p, q, c, t * c);
            }
        }
        if !changed {
            break;
        }
    }
    (0..n).map(|i| m[i][i]).collect()
}

fn rotate(m: &mut [Vec<f64>], p: usize, q: usize, c: f64, s: f64) {
    for row in m.iter_mut() {
        let (a, b) = (row[p], row[q]);
        (row[p], row[q]) = (c * a - s * b, s * a + c * b);
    }
    let (above, below) = m.split_at_mut(q);
    for (a, b) in above[p].iter_mut().zip(&mut below[0]) {
        (*a, *b) = (c * *a - s * *b, s * *a + c * *b);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_matrices() {
        let d = [1e8, 0.0, 0.0, 1.0];
        assert_eq!((condition(&d), scaled_condition(&d)), (1e8, 1.0));
        // Eigenvalues 3 and 1.
        let d = [2.0, 1.0, 1.0, 2.0];
        assert!((condition(&d) - 3.0).abs() < 1e-14 && (scaled_condition(&d) - 3.0).abs() < 1e-14);
        for singular in [
            [1.0, 0.0, 0.0, 0.0],
            [1.0, 1.0, 1.0, 1.0],
            [1.0, 0.0, 0.0, -0.1],
        ] {
            assert_eq!(condition(&singular), f64::INFINITY);
        }
    }
}
