//! Products of long columns, in a fixed order: the same on every machine.
//!
//! Counted loops and lanes written out: a macro runs this code as it was compiled
//! for it, as a rule unoptimised, where iterators take five times as long.

/// Rows that are taken together: of a hundred columns they fit a cache.
const BLOCK: usize = 512;

/// Errors that go through J side by side.
pub(in crate::approximate::prune) const LANES: usize = 8;

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
            let column = &column[index * BLOCK..][..errors.len()];
            let mut sums = *product;
            let mut k = 0;
            while k < column.len() {
                add(&mut sums, column[k], &errors[k]);
                k += 1;
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
            let column = &column[index * BLOCK..][..errors.len()];
            let mut k = 0;
            while k < column.len() {
                add(&mut errors[k], -column[k], change);
                k += 1;
            }
        }
    }
}

/// a + x·b
#[inline(always)]
fn add(a: &mut Lanes, x: f64, b: &Lanes) {
    a[0] += x * b[0];
    a[1] += x * b[1];
    a[2] += x * b[2];
    a[3] += x * b[3];
    a[4] += x * b[4];
    a[5] += x * b[5];
    a[6] += x * b[6];
    a[7] += x * b[7];
}

/// Eight sums side by side, which is quick.
pub(in crate::approximate::prune) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let len = a.len().min(b.len());
    let (a, b) = (&a[..len], &b[..len]);
    let mut sums = [0.0; 8];
    let mut k = 0;
    while k + 8 <= len {
        sums[0] += a[k] * b[k];
        sums[1] += a[k + 1] * b[k + 1];
        sums[2] += a[k + 2] * b[k + 2];
        sums[3] += a[k + 3] * b[k + 3];
        sums[4] += a[k + 4] * b[k + 4];
        sums[5] += a[k + 5] * b[k + 5];
        sums[6] += a[k + 6] * b[k + 6];
        sums[7] += a[k + 7] * b[k + 7];
        k += 8;
    }
    let rest: f64 = a[k..].iter().zip(&b[k..]).map(|(x, y)| x * y).sum();
    sums.iter().sum::<f64>() + rest
}
