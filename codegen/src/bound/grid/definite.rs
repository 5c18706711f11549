//! The least eigenvalue of a symmetric matrix of trigonometric polynomials.
//!
//! **Soundness.** Let μ be the least eigenvalue of A over the box, at x₀ with the unit vector v,
//! and Λ at least |A| everywhere. F = Λ − vᵀAv is a trigonometric polynomial, 0 ≤ F ≤ 2Λ, and over
//! the box it is largest at x₀, Λ − μ. So what holds of |T| holds of F: μ ≥ Λ − B is shown by
//! showing Λ − λ_min(A) ≤ B·cos(d·δ) at the cells' middles, since F there is at most that. For
//! whole circles F's maximum must be that of all circles: then the box is all of them; parts use
//! the bound 2Λ of F over circles.
//!
//! At a point, λ_min(A) ≥ t is shown by a Cholesky factorisation of A − t·1: if it runs through in
//! floating point, the matrix is positive up to (n + 1)·u·trace; four times that, and what the
//! entries' arithmetic costs, are taken off t.

use super::NEGLIGIBLE;
use super::cells::Cells;
use super::harmonics::harmonics;
use super::layout::Layout;
use crate::bound::expand::{Key, Polynomial};
use crate::bound::input_box::InputBox;
use crate::interval::Interval;
use crate::random::Random;

const SAMPLES: usize = 500;

const PARTS: [f64; 4] = [0.8, 0.5, 0.2, 0.02];

/// A part of the points is tried first, and says how far all of them would go.
const TRIAL: usize = 16;

/// Where all of them would not go this part of the way, the rest are not tried: of
/// the angles some are harder than others, but not by that much.
const HOPELESS: f64 = 0.1;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::bound) enum Wanted {
    Most,
    Any,
}

/// Each entry is known up to `errors`. `None` if `wanted` was not shown within so many points.
pub(in crate::bound) fn least_eigenvalue(
    entries: &[Polynomial],
    errors: &[f64],
    limits: &InputBox,
    sliding: &[bool],
    points: usize,
    wanted: Wanted,
) -> Option<f64> {
    let n = size_of(entries.len());
    // The entry takes the place of the rates, of which there must be none.
    let mut all: Vec<(Key, Interval)> = Vec::new();
    let mut size = vec![0.0; entries.len()];
    let mut off = errors.to_vec();
    let entries = entries
        .iter()
        .map(|entry| harmonics(entry, limits.joints()));
    let entries: Vec<Polynomial> = entries.collect::<Option<_>>()?;
    let largest = entries.iter().flatten().map(|(_, x)| x.magnitude());
    let least = NEGLIGIBLE * largest.fold(0.0, f64::max);
    for (index, entry) in entries.iter().enumerate() {
        for &(key, x) in entry {
            if key & 0xffff != 0 {
                return None;
            }
            size[index] += x.magnitude();
            let radius = match x.magnitude().next_up() <= least {
                true => x.magnitude(),
                false => x.radius(),
            };
            off[index] += radius * (1.0 + 1e-9);
            all.push((key | index as Key, x));
        }
    }
    let row_sum = |of: &[f64]| {
        let row = |i: usize| (0..n).map(|j| of[place(i, j)]).sum::<f64>();
        (0..n).map(row).fold(0.0, f64::max) * (1.0 + 1e-12)
    };
    let layout = Layout::new(&all, limits, sliding, &|_| Interval::ONE, least);
    for (off, size) in off.iter_mut().zip(&size) {
        *off += layout.rounding * size;
    }
    let (most, lost) = (row_sum(&size), row_sum(&off));
    let matrix = |values: &[f64]| {
        let mut matrix = vec![0.0; entries.len()];
        for (x, key) in values.iter().zip(&layout.rest) {
            matrix[(key & 0xffff) as usize] += x;
        }
        matrix
    };
    let accept =
        |values: &[f64], bound: f64| exceeds(matrix(values), n, (most - bound).next_up() + lost);
    let whole = layout.part.contains(&true).then_some(2.0 * most);
    let mut cells = Cells::new(&layout, limits, whole, &accept);
    let seen = sampled(&mut cells, &matrix, n, most);
    let mut is_shown = |least: f64| {
        let bound = (most - least).next_down();
        cells.points = points / TRIAL;
        if least <= 0.0 || cells.below(0, bound) {
            return least > 0.0;
        }
        // With points left, it was a cell that cannot be shown.
        let hopeless = cells.reached * (TRIAL as f64) < HOPELESS;
        if cells.points > 0 || hopeless {
            return false;
        }
        cells.points = points;
        cells.below(0, bound)
    };
    let [tighter @ .., easiest] = PARTS.map(|part| part * seen);
    match wanted {
        Wanted::Any => is_shown(easiest).then_some(easiest),
        // Where the easiest part cannot be shown, no other can: a refusal comes early.
        Wanted::Most if !is_shown(easiest) => None,
        Wanted::Most => {
            let mut tighter = tighter.into_iter();
            tighter.find(|&least| is_shown(least)).or(Some(easiest))
        }
    }
}

fn sampled(cells: &mut Cells<'_>, matrix: &dyn Fn(&[f64]) -> Vec<f64>, n: usize, most: f64) -> f64 {
    let mut random = Random::new(0xde7);
    let (last, mut least) = (cells.layout.joints.len(), most);
    for _ in 0..SAMPLES {
        for level in 0..last {
            let (low, width) = cells.span(level);
            let angle = low + width * random.unit();
            cells.place(level, angle);
        }
        let here = matrix(cells.values(last));
        while least > 1e-12 * most && !exceeds(here.clone(), n, least) {
            least *= 0.97;
        }
    }
    if least > 1e-12 * most { least } else { 0.0 }
}

fn size_of(entries: usize) -> usize {
    (0..).find(|n| n * (n + 1) / 2 >= entries).unwrap_or(0)
}

fn place(i: usize, j: usize) -> usize {
    let (row, column) = (i.max(j), i.min(j));
    row * (row + 1) / 2 + column
}

/// `true` is a proof.
fn exceeds(mut a: Vec<f64>, n: usize, t: f64) -> bool {
    let trace: f64 = (0..n).map(|i| a[place(i, i)].abs()).sum();
    let margin = 4.0 * (n as f64 + 2.0) * f64::EPSILON * (trace + n as f64 * t.abs());
    for i in 0..n {
        a[place(i, i)] -= t + margin;
    }
    for j in 0..n {
        let mut pivot = a[place(j, j)];
        for k in 0..j {
            pivot -= a[place(j, k)] * a[place(j, k)];
        }

        if pivot.is_nan() || pivot <= 0.0 {
            return false;
        }
        let root = pivot.sqrt();
        a[place(j, j)] = root;
        for i in j + 1..n {
            let mut sum = a[place(i, j)];
            for k in 0..j {
                sum -= a[place(i, k)] * a[place(j, k)];
            }
            a[place(i, j)] = sum / root;
        }
    }
    true
}
