//! Products of velocities at the worst corner of their box.
//!
//! A sum of f q̇ᵢq̇ⱼ and g q̇ᵢ, with each velocity from −1 to 1, is linear in each, so that its ends
//! are where all are −1 or 1. The sign of a product is the parity of a set of velocities: a Walsh
//! transform gives the sum at all corners.

use super::terms::{TermKey, Terms, group, multiple, without_group, without_phases};

/// The most velocities whose corners are tried: beyond, each product counts by itself.
pub(super) const MOST_VELOCITIES: usize = 12;

/// A factor of a group of terms: none, a product of velocities by its set or an entry of a matrix by
/// its place, or any monomial.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Factor {
    One,
    Place(u32),
    Other,
}

/// The chains of comparisons.
const SIDE: usize = 8;
const MOST_PLACES: usize = 1 << 18;
const ASIDE: u32 = u32::MAX;

/// Returns the least and the largest value at all corners; the sums are by set, and are lost.
pub fn corners(sums: &mut [f64]) -> [f64; 2] {
    // Two steps at once: loops over one and over two values take longer than the sums.
    let mut done = 1;
    if sums.len() >= 4 {
        for chunk in sums.chunks_exact_mut(4) {
            let x = [chunk[0] + chunk[1], chunk[0] - chunk[1]];
            let y = [chunk[2] + chunk[3], chunk[2] - chunk[3]];
            (chunk[0], chunk[1]) = (x[0] + y[0], x[1] + y[1]);
            (chunk[2], chunk[3]) = (x[0] - y[0], x[1] - y[1]);
        }
        done = 4;
    }
    transform(sums, done);
    // Eight chains: one chain of comparisons takes as long as all sums.
    let [mut low, mut high] = [[f64::INFINITY; SIDE], [f64::NEG_INFINITY; SIDE]];
    for chunk in sums.chunks(SIDE) {
        for (k, x) in chunk.iter().enumerate() {
            low[k] = if *x < low[k] { *x } else { low[k] };
            high[k] = if *x > high[k] { *x } else { high[k] };
        }
    }
    let low = low.into_iter().fold(f64::INFINITY, f64::min);
    [low, high.into_iter().fold(f64::NEG_INFINITY, f64::max)]
}

/// Turns rows of so many sums by set into sums at corners.
fn transform(sums: &mut [f64], mut half: usize) {
    while half < sums.len() {
        for chunk in sums.chunks_exact_mut(2 * half) {
            let (left, right) = chunk.split_at_mut(half);
            for (x, y) in left.iter_mut().zip(right) {
                (*x, *y) = (*x + *y, *x - *y);
            }
        }
        half *= 2;
    }
}

/// The places of a level's values: a row for each set of velocities, a column for each multiple of the
/// angles and phase.
pub(super) struct Table {
    width: usize,
    rows: usize,
    /// The place of each value; [`ASIDE`] for those that count by themselves.
    at: Vec<u32>,
    /// The end of each run of columns that differ by phases, and the square of the level's multiple.
    runs: Vec<(u32, f64)>,
    /// The runs of values that count by themselves.
    others: Vec<(u32, u32, f64)>,
}

impl Table {
    /// Returns the table of a level's terms, if it is not too large. A run has its end, the square of the
    /// joint's multiple and its group.
    pub(super) fn new(
        keys: &[TermKey],
        level: &[(u32, f64, u32)],
        terms: &Terms,
        joint: usize,
    ) -> Option<Table> {
        let (factors, velocities) = (&terms.factors, terms.velocities);
        let class = |key: &TermKey| (without_phases(without_group(*key)), without_group(*key));
        let is_other = |key: &TermKey| factors[group(*key)] == Factor::Other;
        let known = keys.iter().filter(|key| !is_other(key));
        let mut columns: Vec<(TermKey, TermKey)> = known.map(class).collect();
        columns.sort_unstable();
        columns.dedup();
        let (width, rows) = (columns.len(), 1 << velocities);
        if velocities == 0 || width == 0 || width * rows > MOST_PLACES {
            return None;
        }
        let place = |key: &TermKey| {
            let row = match factors[group(*key)] {
                Factor::One => 0,
                Factor::Place(set) => set,
                Factor::Other => return ASIDE,
            };
            let column = columns.binary_search(&class(key)).unwrap_or(0);
            row * width as u32 + column as u32
        };
        let mut end = 0;
        let runs = columns.chunk_by(|a, b| a.0 == b.0).map(|run| {
            end += run.len() as u32;
            (end, f64::from(multiple(run[0].1, joint).0).powi(2))
        });
        let (mut from, mut others) = (0, Vec::new());
        for &(end, square, group) in level {
            if factors[group as usize] == Factor::Other {
                others.push((from, end, square));
            }
            from = end;
        }
        Some(Table {
            width,
            rows,
            at: keys.iter().map(place).collect(),
            runs: runs.collect(),
            others,
        })
    }

    /// Returns bounds of F and of its second derivative by the level's angle, by lengths over phases at
    /// each corner.
    pub(super) fn bound(&self, values: &[f64], sums: &mut Vec<f64>) -> (f64, f64) {
        let (width, rows) = (self.width, self.rows);
        sums.clear();
        sums.resize(width * rows, 0.0);
        for (value, at) in values.iter().zip(&self.at) {
            if let Some(sum) = sums.get_mut(*at as usize) {
                *sum += value;
            }
        }
        transform(sums, width);
        let [mut most, mut bend] = [0.0f64; 2];
        for row in sums.chunks_exact(width) {
            let ([mut total, mut bent], mut from) = ([0.0f64; 2], 0);
            for &(end, square) in &self.runs {
                let length = length(&row[from..end as usize]);
                total += length;
                bent += length * square;
                from = end as usize;
            }
            (most, bend) = (most.max(total), bend.max(bent));
        }
        for &(from, end, square) in &self.others {
            let length = length(&values[from as usize..end as usize]);
            most += length;
            bend += length * square;
        }
        (most, bend)
    }
}

/// Returns the largest value over the phases of a multiple.
pub(super) fn length(run: &[f64]) -> f64 {
    match run {
        [one] => one.abs(),
        _ => run.iter().map(|x| x * x).sum::<f64>().sqrt(),
    }
}
