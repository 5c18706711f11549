//! Products of long columns, in a fixed order: the same on every machine.
//!
//! Counted loops and lanes written out: a macro runs this code as it was compiled
//! for it, as a rule unoptimised, where iterators take five times as long.

/// Rows that a Gram matrix takes together: of a hundred columns they fit a cache.
const BLOCK: usize = 512;

const ROWS: usize = 128;

pub(in crate::approximate::prune) const LANES: usize = 8;

pub(super) type Lanes = [f64; LANES];

/// J by columns. A constant of one link moves the outputs of some joints only, so
/// that many blocks of a column are zero: they change no sum and are left out.
#[derive(Clone, Debug, Default)]
pub(super) struct Columns {
    pub columns: Vec<Vec<f64>>,
    /// For each block of [`ROWS`] rows, the columns that are not zero there.
    live: Vec<Vec<usize>>,
}

impl Columns {
    pub(super) fn of(columns: Vec<Vec<f64>>) -> Columns {
        let rows = columns.first().map_or(0, Vec::len);
        let live = (0..rows).step_by(ROWS).map(|from| {
            let of = columns.iter().enumerate();
            let of = of.filter(|(_, column)| is_live(&column[from..(from + ROWS).min(rows)]));
            of.map(|(index, _)| index).collect()
        });
        Columns {
            live: live.collect(),
            columns,
        }
    }

    /// Two columns at a time: each sum is the one that it would be alone.
    pub(super) fn transposed(&self, errors: &[Lanes]) -> Vec<Lanes> {
        let mut products = vec![[0.0; LANES]; self.columns.len()];
        let blocks = errors.chunks(ROWS).zip(&self.live);
        for (block, (errors, live)) in blocks.enumerate() {
            let part = |index: usize| &self.columns[index][block * ROWS..][..errors.len()];
            for pair in live.chunks(2) {
                let (first, second) = (pair[0], pair.get(1).copied());
                let a = part(first);
                let mut sums = products[first];
                match second {
                    Some(second) => {
                        let b = part(second);
                        let mut others = products[second];
                        let mut k = 0;
                        while k < errors.len() {
                            add(&mut sums, a[k], &errors[k]);
                            add(&mut others, b[k], &errors[k]);
                            k += 1;
                        }
                        products[second] = others;
                    }
                    None => {
                        let mut k = 0;
                        while k < errors.len() {
                            add(&mut sums, a[k], &errors[k]);
                            k += 1;
                        }
                    }
                }
                products[first] = sums;
            }
        }
        products
    }

    pub(super) fn subtract(&self, changes: &[Lanes], errors: &mut [Lanes]) {
        let blocks = errors.chunks_mut(ROWS).zip(&self.live);
        for (block, (errors, live)) in blocks.enumerate() {
            let rows = errors.len();
            let part = |index: usize| &self.columns[index][block * ROWS..][..rows];
            let mut fours = live.chunks_exact(4);
            for four in fours.by_ref() {
                let [a, b, c, d] = [0, 1, 2, 3].map(|k| part(four[k]));
                let by = [0, 1, 2, 3].map(|k| changes[four[k]]);
                let mut k = 0;
                while k < rows {
                    let mut row = errors[k];
                    add(&mut row, -a[k], &by[0]);
                    add(&mut row, -b[k], &by[1]);
                    add(&mut row, -c[k], &by[2]);
                    add(&mut row, -d[k], &by[3]);
                    errors[k] = row;
                    k += 1;
                }
            }
            for &index in fours.remainder() {
                let (column, change) = (part(index), &changes[index]);
                let mut k = 0;
                while k < rows {
                    add(&mut errors[k], -column[k], change);
                    k += 1;
                }
            }
        }
    }
}

fn is_live(part: &[f64]) -> bool {
    part.iter().any(|x| *x != 0.0)
}

pub(super) fn gram(columns: &[&[f64]]) -> Vec<Vec<f64>> {
    let rows = columns.first().map_or(0, |column| column.len());
    let mut gram: Vec<Vec<f64>> = (0..columns.len()).map(|k| vec![0.0; k + 1]).collect();
    for from in (0..rows).step_by(BLOCK) {
        let block = from..(from + BLOCK).min(rows);
        let live: Vec<bool> = (columns.iter().map(|a| is_live(&a[block.clone()]))).collect();
        for (index, row) in gram
            .iter_mut()
            .enumerate()
            .filter(|(index, _)| live[*index])
        {
            let a = &columns[index][block.clone()];
            for (other, sum) in row.iter_mut().enumerate().filter(|(other, _)| live[*other]) {
                *sum += dot(a, &columns[other][block.clone()]);
            }
        }
    }
    gram
}

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

/// Computes a product in eight sums side by side: a fixed order, and no chain of additions.
pub(in crate::approximate) fn dot(a: &[f64], b: &[f64]) -> f64 {
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
