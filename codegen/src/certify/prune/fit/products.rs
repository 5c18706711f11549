//! Products of long columns, in a fixed order: the same on every machine.

/// Rows that are taken together: of a hundred columns they fit a cache.
const BLOCK: usize = 512;

/// Errors that go through J side by side.
pub(in crate::certify::prune) const LANES: usize = 8;

/// A row of theirs.
pub(super) type Lanes = [f64; LANES];

/// JᵀJ, the lower triangle.
pub(super) fn gram(columns: &[&[f64]]) -> Vec<Vec<f64>> {
    let rows = columns.first().map_or(0, |column| column.len());
    let mut gram: Vec<Vec<f64>> = (0..columns.len()).map(|k| vec![0.0; k + 1]).collect();
    for from in (0..rows).step_by(BLOCK) {
        let block = from..(from + BLOCK).min(rows);
        for (row, a) in gram.iter_mut().zip(columns) {
            for (sum, b) in row.iter_mut().zip(columns) {
                *sum += dot(&a[block.clone()], &b[block.clone()]);
            }
        }
    }
    gram
}

/// JᵀE.
pub(super) fn transposed(columns: &[Vec<f64>], errors: &[Lanes]) -> Vec<Lanes> {
    let mut products = vec![[0.0; LANES]; columns.len()];
    for (index, errors) in errors.chunks(BLOCK).enumerate() {
        for (column, product) in columns.iter().zip(&mut products) {
            let mut sums = *product;
            for (row, x) in errors.iter().zip(&column[index * BLOCK..]) {
                for (sum, error) in sums.iter_mut().zip(row) {
                    *sum += x * error;
                }
            }
            *product = sums;
        }
    }
    products
}

/// E − J·δ.
pub(super) fn subtract(columns: &[Vec<f64>], changes: &[Lanes], errors: &mut [Lanes]) {
    for (index, errors) in errors.chunks_mut(BLOCK).enumerate() {
        for (column, change) in columns.iter().zip(changes) {
            for (row, x) in errors.iter_mut().zip(&column[index * BLOCK..]) {
                for (error, change) in row.iter_mut().zip(change) {
                    *error -= x * change;
                }
            }
        }
    }
}

/// Eight sums side by side, which is quick.
pub(in crate::certify::prune) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; 8];
    let (a, b) = (a.chunks_exact(8), b.chunks_exact(8));
    let rest: f64 = a
        .remainder()
        .iter()
        .zip(b.remainder())
        .map(|(x, y)| x * y)
        .sum();
    for (x, y) in a.zip(b) {
        for k in 0..8 {
            sums[k] += x[k] * y[k];
        }
    }
    sums.iter().sum::<f64>() + rest
}
