//! Least squares over columns, with a prior for each unknown.

use super::work;

/// Returns a·b in eight sums side by side: a fixed order, which runs in vectors.
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    work::count(a.len() / work::UNIT);
    let mut sums = [0.0; 8];
    let (x, y) = (a.chunks_exact(8), b.chunks_exact(8));
    let rest = x.remainder().iter().zip(y.remainder());
    for (x, y) in x.zip(y) {
        for k in 0..8 {
            sums[k] += x[k] * y[k];
        }
    }
    sums.iter().sum::<f64>() + rest.map(|(x, y)| x * y).sum::<f64>()
}

/// The factor L of a symmetric matrix A = L·Lᵀ, row by row.
pub(super) struct Factor(Vec<Vec<f64>>);

/// The part of a square that is left at least: columns that others can replace get no weight.
const RIDGE: f64 = 1e-12;

impl Factor {
    /// Factors a matrix by its lower triangle.
    pub(super) fn new(size: usize, entry: impl Fn(usize, usize) -> f64) -> Factor {
        let mut l: Vec<Vec<f64>> = Vec::with_capacity(size);
        for a in 0..size {
            let mut row: Vec<f64> = Vec::with_capacity(a + 1);
            for b in 0..a {
                let known = dot(&row, &l[b][..b]);
                row.push((entry(a, b) - known) / l[b][b]);
            }
            let diagonal = entry(a, a);
            let left = (diagonal - dot(&row, &row)).max(RIDGE * diagonal + f64::MIN_POSITIVE);
            row.push(left.sqrt());
            l.push(row);
        }
        Factor(l)
    }

    /// Returns L⁻¹ y.
    pub(super) fn forward(&self, mut y: Vec<f64>) -> Vec<f64> {
        for (k, row) in self.0.iter().enumerate() {
            y[k] = (y[k] - dot(&row[..k], &y[..k])) / row[k];
        }
        y
    }

    /// Returns A⁻¹ y.
    pub(super) fn solve(&self, y: Vec<f64>) -> Vec<f64> {
        let mut y = self.forward(y);
        for (k, row) in self.0.iter().enumerate().rev() {
            let x = y[k] / row[k];
            y[k] = x;
            y[..k].iter_mut().zip(row).for_each(|(y, l)| *y -= x * l);
        }
        y
    }

    /// Returns A⁻¹.
    pub(super) fn inverse(&self) -> Vec<Vec<f64>> {
        let size = self.0.len();
        let unit = |k: usize| (0..size).map(move |j| f64::from(u8::from(j == k)));
        (0..size).map(|k| self.solve(unit(k).collect())).collect()
    }
}
