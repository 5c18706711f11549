//! Triangular systems and singular values; matrices are whole, row by row.
//!
//! nalgebra has these of floats only with `std` or `libm`. Cargo would give either to all crates
//! of a program, and `std` the platform's functions: results would differ between machines.

pub(crate) fn back_substitute(r: &[f64], b: &[f64]) -> Vec<f64> {
    let n = b.len();
    let mut x = b.to_vec();
    for i in (0..n).rev() {
        let row = &r[i * n..(i + 1) * n];
        x[i] = (x[i] - dot(&row[i + 1..], &x[i + 1..])) / row[i];
    }
    x
}

/// Computes A R⁻¹ for an upper triangle R, both n×n.
pub(crate) fn over(a: &[f64], r: &[f64], n: usize) -> Vec<f64> {
    let mut x = a.to_vec();
    for row in x.chunks_mut(n.max(1)) {
        for k in 0..n {
            let known: f64 = (0..k).map(|i| row[i] * r[i * n + k]).sum();
            row[k] = (row[k] - known) / r[k * n + k];
        }
    }
    x
}

pub(crate) fn apply(a: &[f64], x: &[f64]) -> Vec<f64> {
    a.chunks(x.len().max(1)).map(|row| dot(row, x)).collect()
}

pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Returns R, whole rows, and z of a triangle [R z; 0 ρ].
pub(crate) fn split(factor: &[f64], columns: usize) -> (Vec<f64>, Vec<f64>) {
    let rows = factor.chunks(columns + 1).take(columns);
    let z = rows.clone().map(|row| row[columns]).collect();
    let r = rows.flat_map(|row| &row[..columns]).copied().collect();
    (r, z)
}

pub(crate) fn norms(a: &[f64], columns: usize) -> Vec<f64> {
    let norm = |k: usize| {
        let squares = a.iter().skip(k).step_by(columns).map(|x| x.powi(2));
        libm::sqrt(squares.sum())
    };
    (0..columns).map(norm).collect()
}

/// A singular value decomposition by its columns: A v_k = σ_k u_k.
pub(crate) struct Singular {
    /// σ_k, not sorted.
    pub(crate) values: Vec<f64>,
    pub(crate) images: Vec<Vec<f64>>,
    pub(crate) directions: Vec<Vec<f64>>,
}

/// Decomposes a square matrix by one-sided Jacobi rotations (Golub and Van Loan, 8.6.3):
/// slower than a bidiagonalization, and small values are accurate.
pub(crate) fn singular(a: &[f64], n: usize) -> Singular {
    let column = |k: usize| (0..n).map(|i| a[i * n + k]).collect();
    let mut images: Vec<Vec<f64>> = (0..n).map(column).collect();
    let unit = |k: usize| (0..n).map(|i| f64::from(u8::from(i == k))).collect();
    let mut directions: Vec<Vec<f64>> = (0..n).map(unit).collect();
    let rounding = f64::EPSILON * n as f64;
    // Sweeps converge quadratically: more than a dozen are never needed.
    for _ in 0..40 {
        let mut turned = false;
        for p in 0..n {
            for q in p + 1..n {
                let [pp, qq] = [p, q].map(|k| dot(&images[k], &images[k]));
                let pq = dot(&images[p], &images[q]);
                if pq.abs() <= rounding * libm::sqrt(pp * qq) || pq == 0.0 {
                    continue;
                }
                turned = true;
                let zeta = (qq - pp) / (2.0 * pq);
                let size = zeta.abs() + libm::sqrt(1.0 + zeta * zeta);
                let t = if zeta < 0.0 { -1.0 / size } else { 1.0 / size };
                let cos = 1.0 / libm::sqrt(1.0 + t * t);
                for columns in [&mut images, &mut directions] {
                    let (left, right) = columns.split_at_mut(q);
                    for (x, y) in left[p].iter_mut().zip(&mut right[0]) {
                        (*x, *y) = (cos * (*x - t * *y), cos * (*y + t * *x));
                    }
                }
            }
        }
        if !turned {
            break;
        }
    }
    let size = |column: &Vec<f64>| libm::sqrt(dot(column, column));
    Singular {
        values: images.iter().map(size).collect(),
        images,
        directions,
    }
}

pub(crate) fn cholesky<const N: usize>(a: &[[f64; N]; N]) -> Option<[[f64; N]; N]> {
    let mut l = [[0.0; N]; N];
    for (i, row) in a.iter().enumerate() {
        for (k, entry) in row.iter().enumerate().take(i + 1) {
            let known: f64 = (0..k).map(|j| l[i][j] * l[k][j]).sum();
            let rest = entry - known;
            if i == k {
                if rest.is_nan() || rest <= 0.0 {
                    return None;
                }
                l[i][i] = libm::sqrt(rest);
            } else {
                l[i][k] = rest / l[k][k];
            }
        }
    }
    Some(l)
}
