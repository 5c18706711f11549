//! A symmetric matrix of polynomials that is positive definite over the box.
//!
//! With Λ at least |A| everywhere, λ the least eigenvalue of A at a state and v its unit vector, F =
//! Λ − vᵀAv is a trigonometric polynomial with 0 ≤ F ≤ 2Λ, and F = Λ − λ there: what is said of F in
//! the module holds of the largest of all these. At a state λ ≥ t is shown by a Cholesky
//! factorisation of A − t: if it runs through in doubles, the matrix is positive but for (n + 1)·u
//! times its trace, of which four times as much is taken off.

use super::climb::next;
use super::corners::Factor;
use super::search::{Aim, Search, Verdict};
use super::terms::{TermKey, Terms, group};
use crate::polynomial::Polynomial;
use crate::ring::Ring;

const PURSE: u64 = 2_000_000_000;
const SAMPLES: usize = 200;
const SEED: u64 = 0xde7;
/// The part of the least eigenvalue of the samples that is shown.
const PART: f64 = 0.05;
/// The loss in the last cell that is cut, relative to the least eigenvalue of the samples.
const LEAST_LOSS: f64 = 0.2;

/// Returns true if the matrix is shown to be positive definite; its lower triangle is given row by
/// row, and how far each entry may be off.
pub fn is_definite(entries: &[Polynomial], errors: &[f64], ring: &Ring) -> bool {
    let has_room = |n: &usize| n * (n + 1) / 2 >= entries.len();
    let size = (0..).find(has_room).unwrap_or(0);
    let diagonal = |i: usize| ring.size(&entries[place(i, i)]);
    // A power of two: exact. The matrix has no units then.
    let unit = |size: f64| 0.5f64.powi((0.5 * size.log2()).round() as i32);
    let units: Vec<f64> = (0..size).map(|i| unit(diagonal(i))).collect();
    let mut matrix = Terms::default();
    let [mut off, mut sizes] = [vec![0.0; entries.len()], vec![0.0; entries.len()]];
    for i in 0..size {
        for j in 0..=i {
            let (at, unit) = (place(i, j), units[i] * units[j]);
            let entry = Terms::new(&entries[at], ring, 0.0);
            off[at] = (entry.rest + errors[at]) * unit;
            for &(key, value) in &entry.terms {
                let value = value * unit;
                // A factor of a rate, or of the error of a sine, is at most so large.
                match entry.factors[group(key)] {
                    Factor::One => {
                        let placed = key - group(key) as TermKey + at as TermKey;
                        matrix.terms.push((placed, value));
                        sizes[at] += value.abs();
                    }
                    _ => off[at] += value.abs(),
                }
            }
            matrix.factors.push(Factor::Place(at as u32));
        }
    }
    let largest = norm(&sizes, size);
    matrix.rest = norm(&off, size);
    if !(largest + matrix.rest).is_finite() {
        return false;
    }
    let mut search = Search::new(&matrix, ring);
    search.aim = Aim::Eigenvalue { size, largest };
    search.corner = vec![0.0; entries.len()];
    search.steps = PURSE;
    let eigenvalue = search.sampled(size, largest);
    search.least_loss = Some(LEAST_LOSS * eigenvalue);
    let least = PART * eigenvalue;
    least > 0.0
        && match search.is_constant() {
            true => search.is_at_most((largest - least).next_down()),
            false => search.shows_all((largest - least).next_down()) == Verdict::Yes,
        }
}

impl Search {
    /// Returns true if the least eigenvalue is shown to be at least t whatever the angles are that are
    /// not put in, and a bound of the second derivative by the level's angle.
    pub(super) fn crude_matrix(&mut self, level: usize, size: usize, t: f64) -> (bool, f64) {
        let layout = &self.levels[level];
        let column = &self.columns[level];
        let values = &column[column.len() - layout.parts.len()..];
        let [mut lengths, mut bends] = [vec![0.0; self.corner.len()], vec![0.0; self.corner.len()]];
        let (mut from, mut next) = (0, layout.constants.iter().peekable());
        self.corner.fill(0.0);
        for &(end, square, entry) in &layout.runs {
            let run = &values[from..end as usize];
            let constant = next.next_if(|place| **place as usize == from);
            if constant.is_some() {
                self.corner[entry as usize] += run[0];
            } else {
                let length = run.iter().map(|x| x * x).sum::<f64>().sqrt();
                lengths[entry as usize] += length;
                bends[entry as usize] += length * square;
            }
            from = end as usize;
        }
        let degree = layout.degree.powi(2);
        let bend = norm(&bends, size) + degree * self.slack;
        let most = norm(&lengths, size) + self.slack;
        self.steps = self.steps.saturating_sub((size * size * size) as u64);
        let is_small = exceeds(self.corner.clone(), size, t.next_up() + most * (1.0 + 1e-9));
        (is_small, bend * (1.0 + 1e-9))
    }

    /// Puts the values behind the last level in the places of their groups.
    pub(super) fn put_in_place(&mut self) {
        let column = &self.columns[self.levels.len()];
        let values = &column[column.len() - self.factors.len()..];
        self.corner.fill(0.0);
        for (value, factor) in values.iter().zip(&self.factors) {
            if let Factor::Place(place) = factor {
                self.corner[*place as usize] += value;
            }
        }
    }

    /// Returns the least eigenvalue at random states, roughly; zero if one is not above zero.
    fn sampled(&mut self, size: usize, largest: f64) -> f64 {
        let ranges = self.ranges();
        let (mut seed, mut least) = (SEED, largest);
        for _ in 0..SAMPLES {
            for (level, [low, high]) in ranges.iter().enumerate() {
                self.fix(level, low + (high - low) * next(&mut seed));
            }
            self.put_in_place();
            while least > 1e-12 * largest && !exceeds(self.corner.clone(), size, least) {
                least *= 0.97;
            }
        }
        if least > 1e-12 * largest { least } else { 0.0 }
    }
}

/// Returns the largest sum of a row: no eigenvalue is larger.
pub(super) fn norm(entries: &[f64], size: usize) -> f64 {
    let row = |i: usize| (0..size).map(|j| entries[place(i, j)]).sum::<f64>();
    (0..size).map(row).fold(0.0, f64::max) * (1.0 + 1e-12)
}

fn place(i: usize, j: usize) -> usize {
    let (row, column) = (i.max(j), i.min(j));
    row * (row + 1) / 2 + column
}

/// Returns true if the least eigenvalue is shown to be above t.
pub(super) fn exceeds(mut a: Vec<f64>, size: usize, t: f64) -> bool {
    let trace: f64 = (0..size).map(|i| a[place(i, i)].abs()).sum();
    let margin = 4.0 * (size as f64 + 2.0) * f64::EPSILON * (trace + size as f64 * t.abs());
    for i in 0..size {
        a[place(i, i)] -= t + margin;
    }
    for j in 0..size {
        let known: f64 = (0..j).map(|k| a[place(j, k)] * a[place(j, k)]).sum();
        let pivot = a[place(j, j)] - known;
        if !(pivot > 0.0) {
            return false;
        }
        let root = pivot.sqrt();
        a[place(j, j)] = root;
        for i in j + 1..size {
            let known: f64 = (0..j).map(|k| a[place(i, k)] * a[place(j, k)]).sum();
            a[place(i, j)] = (a[place(i, j)] - known) / root;
        }
    }
    true
}
