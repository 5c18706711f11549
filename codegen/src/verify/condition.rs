//! The condition of an inertia matrix.

/// The condition of a symmetric positive semidefinite matrix.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Condition {
    /// Largest over least eigenvalue of D.
    pub raw: f64,
    /// The condition of D_ik / √(D_ii D_kk), from which units and sizes of the joints are taken
    /// out.
    pub scaled: f64,
    /// `true` if a pivot of the elimination is below n·u·max D_ii: no solver in this arithmetic
    /// can tell D from a singular matrix.
    pub singular: bool,
    /// `true` if a pivot is negative beyond what rounding explains: no arm has this D.
    pub indefinite: bool,
}

/// A pivot that is so many times n·u·max D_ii below zero is negative.
const BEYOND_ROUNDING: f64 = 1e3;

impl Condition {
    /// Computes the condition of a matrix, row by row, for arithmetic of unit roundoff u.
    pub fn of(d: &[f64], u: f64) -> Condition {
        let n = d.len().isqrt();
        let matrix: Vec<Vec<f64>> = d.chunks(n.max(1)).map(<[f64]>::to_vec).collect();
        let diagonal: Vec<f64> = (0..n).map(|i| matrix[i][i]).collect();
        let entry = |i: usize, k: usize| match (diagonal[i] * diagonal[k]).sqrt() {
            size if size > 0.0 => matrix[i][k] / size,
            _ => 0.0,
        };
        let scaled: Vec<Vec<f64>> = (0..n)
            .map(|i| (0..n).map(|k| entry(i, k)).collect())
            .collect();
        let largest = diagonal.iter().copied().fold(0.0, f64::max);
        let (raw, least, rounding) = (ratio(matrix.clone()), least_pivot(matrix), n as f64 * u);
        Condition {
            raw,
            scaled: ratio(scaled),
            singular: least <= rounding * largest,
            indefinite: least < -BEYOND_ROUNDING * rounding * largest,
        }
    }
}

/// Returns the largest over least eigenvalue, infinite where the least is not positive.
fn ratio(matrix: Vec<Vec<f64>>) -> f64 {
    let values = eigenvalues(matrix);
    let largest = values.iter().copied().fold(0.0, f64::max);
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    if least > 0.0 {
        largest / least
    } else {
        f64::INFINITY
    }
}

/// Returns the least pivot of the elimination without exchanges: for a semidefinite
/// matrix they are all ≥ 0 and need none.
fn least_pivot(mut m: Vec<Vec<f64>>) -> f64 {
    let n = m.len();
    let mut least = f64::INFINITY;
    for i in 0..n {
        let pivot = m[i][i];
        least = least.min(pivot);
        if pivot <= 0.0 {
            return pivot;
        }
        let row = m[i].clone();
        for below in m.iter_mut().skip(i + 1) {
            let factor = below[i] / pivot;
            for (entry, above) in below.iter_mut().zip(&row) {
                *entry -= factor * above;
            }
        }
    }
    least
}

/// Returns Jacobi's rotations: on a matrix with a unit diagonal they find small
/// eigenvalues to relative accuracy.
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

/// Rotates rows and columns p < q.
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
    fn diagonal_sizes_scale_away() {
        let condition = Condition::of(&[1e8, 0.0, 0.0, 1.0], f64::EPSILON / 2.0);
        assert_eq!(condition.raw, 1e8);
        assert_eq!(condition.scaled, 1.0);
        assert!(!condition.singular);
    }

    #[test]
    fn a_known_matrix() {
        // Eigenvalues 3 and 1.
        let condition = Condition::of(&[2.0, 1.0, 1.0, 2.0], f64::EPSILON / 2.0);
        assert!((condition.raw - 3.0).abs() < 1e-14);
        assert!((condition.scaled - 3.0).abs() < 1e-14);
    }

    #[test]
    fn a_massless_link_is_singular() {
        let u = f64::EPSILON / 2.0;
        assert!(Condition::of(&[1.0, 0.0, 0.0, 0.0], u).singular);
        assert!(!Condition::of(&[1.0, 0.0, 0.0, -u], u).indefinite);
        assert!(Condition::of(&[1.0, 0.0, 0.0, -0.1], u).indefinite);
        assert!(Condition::of(&[1.0, 1.0, 1.0, 1.0], u).singular);
    }
}
