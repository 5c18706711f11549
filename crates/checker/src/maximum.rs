//! The largest magnitude of a polynomial over the box.
//!
//! Rates and errors enter monomial by monomial, each at its worst: with the middle μ and
//! half the length ρ of a monomial's range, and g its coefficient, a trigonometric
//! polynomial in the angles, |P| ≤ F = |Σ μ g| + Σ ρ |g|; but products of velocities, and
//! what is linear in one, at the worst corner of their box together. That F ≤ B everywhere
//! is shown angle by angle. At given other angles let F be largest, M, at x in a cell of middle c
//! and half width δ, and let d be the degree in this angle. F is the maximum of finitely
//! many trigonometric polynomials ±g ± …, and of the one that is M at x:
//!
//! - if the angle goes all the way round, M. Riesz: its value at c is at least
//!   M·cos(d·δ), for d·δ ≤ π/2. So M ≤ B if F(c) ≤ B·cos(d·δ).
//! - either x is an end of the range, and ends are looked at; or its slope at x is 0, and M ≤
//!   F(c) + ½δ²·W. W = Σ n·|v| is at least the second derivative: a product of n sines and
//!   cosines is the mean of cos(Σ ±(θ − φ)) over all signs, and the mean of (Σ ±1)² is n.
//!
//! F(c) is shown to be small by the same means over the other angles. Cells where that
//! fails are cut in three; what is found above B itself is an answer: F is not below B.

use std::f64::consts::PI;

use crate::interval::{UNIT, sin_cos};
use crate::levels::{Level, Search};
use crate::polynomial::Polynomial;
use crate::ring::Ring;

/// The most multiplications: for all results of a function, and for each B above the wanted one.
pub const MOST_STEPS: u64 = 1_500_000_000;
const MOST_STEPS_MORE: u64 = 400_000_000;
/// Cells narrower than this are not cut: what they would show is shown by a larger B.
const NARROWEST: f64 = 1e-3;
/// The part of B that is lost in one of the first cells. Larger ones fail, and what was shown of
/// the other angles was in vain.
const FIRST_LOSS: f64 = 0.087;
const GROWTH: [f64; 7] = [1.002, 1.01, 1.05, 1.2, 1.5, 2.0, 4.0];

const MOST_CELLS: f64 = 1e6;

enum Unshown {
    /// F, or a bound of it that cannot be avoided, is so large somewhere.
    Larger(f64),
    Steps,
}

/// At most `wanted` if that can be shown, else a little above the largest F.
pub fn bound(polynomial: &Polynomial, ring: &Ring, wanted: f64, left: &mut u64) -> f64 {
    let mut search = Search::new(polynomial, ring, *left);
    let first = search.values.first().map(Vec::as_slice).unwrap_or_default();
    let norm: f64 = first.iter().map(|value| value.abs()).sum();
    // What doubles cost: a sum of at most so many products, sines that are 1e-15 off, and
    // what the middles and lengths of ranges were rounded by.
    let counted = 16.0 * UNIT * polynomial.terms.len() as f64;
    let plain = (norm + polynomial.rest) * (1.0 + counted) + search.mass * counted;
    if plain <= wanted || search.levels.is_empty() || !plain.is_finite() {
        return plain;
    }
    let slack = search.mass * (1e-12 + 16.0 * UNIT * first.len() as f64);
    let rest = (polynomial.rest + slack) * (1.0 + 1e-9);
    let (mut least, mut shown) = ((wanted - rest).next_down(), wanted);
    if !(least > 0.0) {
        (least, shown) = (norm * 1e-12, f64::INFINITY);
    }
    for growth in GROWTH {
        for _ in 0..20 {
            let before = search.steps;
            let found = search.shows(0, least);
            *left -= before - search.steps;
            match found {
                Ok(()) if shown == wanted => return wanted,
                Ok(()) => return plain.min((least + rest) * (1.0 + 1e-12)),
                Err(Unshown::Larger(found)) => least = (found * 1.0005).max(least * 1.0005),
                Err(Unshown::Steps) => break,
            }
            shown = f64::INFINITY;
        }
        if !(least * growth < norm) {
            break;
        }
        least *= growth;
        (shown, search.steps) = (f64::INFINITY, MOST_STEPS_MORE.min(*left));
    }
    plain
}

impl Search {
    /// Shows that F ≤ B, the angles of the levels before being put in.
    fn shows(&mut self, level: usize, most: f64) -> Result<(), Unshown> {
        let norm = self.norm(level);
        if norm <= most {
            return Ok(());
        }
        let Some(Level { degree, range, .. }) = self.levels.get(level) else {
            return Err(Unshown::Larger(norm));
        };
        let (degree, range) = (*degree, *range);
        let [low, high] = range.unwrap_or([-PI, PI]);
        let bend = self.bend(level);
        let widest = (2.0 * FIRST_LOSS * most / bend.min(degree * degree * most)).sqrt();
        // Of what is no number, with B below zero, one.
        let count = (0.5 * (high - low) / widest).ceil().max(1.0);
        if !(count < MOST_CELLS) {
            return Err(Unshown::Steps);
        }
        let half = (0.5 * (high - low) / count).next_up();
        let cell = |k: usize| (low + half * (2.0 * k as f64 + 1.0), half);
        let mut cells: Vec<(f64, f64)> = (0..count as usize).map(cell).collect();
        if range.is_some() {
            cells.extend([(low, 0.0), (high, 0.0)]);
        }
        while let Some((middle, half)) = cells.pop() {
            if self.steps == 0 {
                return Err(Unshown::Steps);
            }
            // One part in 10¹² for the roundings of all this.
            let turn = degree * half * (1.0 + 1e-12);
            let bent = most - 0.5 * half * half * bend * (1.0 + 1e-12);
            let below = match range {
                None if turn < 1.5 => bent.max(most * sin_cos(turn).1),
                _ => bent,
            };
            self.fix(level, middle);
            match self.shows(level + 1, below - 1e-12 * most) {
                Ok(()) => {}
                Err(Unshown::Larger(found)) if found > most => return Err(Unshown::Larger(found)),
                Err(Unshown::Larger(_)) if half < NARROWEST => return Err(Unshown::Larger(most)),
                Err(Unshown::Larger(_)) => {
                    let third = half / 3.0;
                    let cut = [middle - 2.0 * third, middle, middle + 2.0 * third];
                    cells.extend(cut.map(|middle| (middle, third.next_up())));
                }
                Err(steps) => return Err(steps),
            }
        }
        Ok(())
    }
}
