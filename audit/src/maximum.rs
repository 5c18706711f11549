//! The largest magnitude of a polynomial over the box.
//!
//! Rates and errors enter monomial by monomial, each at its worst: with the middle μ and
//! half the length ρ of a monomial's range, and g its coefficient, a trigonometric
//! polynomial in the angles, |P| ≤ F = |Σ μ g| + Σ ρ |g|. That F ≤ B everywhere is shown
//! angle by angle. At given other angles let F be largest, M, at x in a cell of middle c
//! and half width δ, and let d be the degree in this angle. F is the maximum of finitely
//! many trigonometric polynomials ±g ± …, and of the one that is M at x:
//!
//! - if the angle goes all the way round, M. Riesz: its value at c is at least
//!   M·cos(d·δ), for d·δ ≤ π/2. So M ≤ B if F(c) ≤ B·cos(d·δ).
//! - if it has ends, either x is one of them, and they are looked at; or its slope at x is
//!   0, and by Bernstein M ≤ F(c) + ½(d·δ)²·W, W being at least F over whole turns.
//!
//! F(c) is shown to be small by the same means over the other angles. Cells where that
//! fails are cut in three; what is found above B itself is an answer: F is not below B.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use crate::interval::{UNIT, sin_cos};
use crate::polynomial::{ANGLES, Key, Polynomial, Variable, exponent, key};
use crate::ring::Ring;

/// The most multiplications for the B that is wanted, and for each larger one.
const MOST_STEPS: u64 = 2_500_000_000;
const MOST_STEPS_MORE: u64 = 400_000_000;
/// Cells narrower than this are not cut: what they would show is shown by a larger B.
const NARROWEST: f64 = 1e-3;
/// The largest d·δ of the first cells. Larger ones fail, and what was shown of the other
/// angles was in vain: the UR10 takes 0.8 s so, 7 s with 0.7 and 0.9 s with 0.25.
const FIRST_TURN: f64 = 0.42;
/// By how much B grows where it was not shown.
const GROWTH: [f64; 7] = [1.002, 1.01, 1.05, 1.2, 1.5, 2.0, 4.0];

/// One angle's turn: what its powers are multiplied with, and where that is added to.
struct Level {
    degree: f64,
    range: Option<[f64; 2]>,
    /// Powers of sin and cos that occur.
    powers: Vec<(u32, u32)>,
    /// Of each coefficient its power and its place among those of the next level.
    moves: Vec<(u32, u32)>,
}

/// F, and the coefficients that are left at each level.
struct Search {
    levels: Vec<Level>,
    values: Vec<Vec<f64>>,
    /// The sum of the magnitudes of all terms, before they were added up.
    mass: f64,
    /// Multiplications that may still be done.
    steps: u64,
}

/// Why F is not known to be at most B.
enum Unshown {
    /// F, or a bound of it that cannot be avoided, is so large somewhere.
    Larger(f64),
    /// It takes too many steps.
    Steps,
}

/// A bound of the magnitude of a polynomial over the box, at most `wanted` if that can be
/// shown, else a little above the largest F.
pub fn bound(polynomial: &Polynomial, ring: &Ring, wanted: f64) -> f64 {
    let mut search = Search::new(polynomial, ring);
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
    let mut least = (wanted - rest).next_down();
    let seen = search.climb();
    let mut shown = wanted;
    if !(seen <= least) {
        least = seen * GROWTH[0];
        shown = f64::INFINITY;
    }
    for growth in GROWTH {
        for _ in 0..20 {
            match search.shows(0, least) {
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
        (shown, search.steps) = (f64::INFINITY, MOST_STEPS_MORE);
    }
    plain
}

impl Search {
    fn new(polynomial: &Polynomial, ring: &Ring) -> Search {
        // Groups by rates and errors; the first one is the sum of all at the middle.
        let mut groups: BTreeMap<(Key, Key), f64> = BTreeMap::new();
        let mut mass = 0.0;
        for &(key, coefficient) in &polynomial.terms {
            let (angles, others) = (key & ANGLES, key & !ANGLES);
            let (middle, radius) = ring.factor(others);
            mass += (middle.abs() + radius) * coefficient.abs();
            if middle != 0.0 {
                *groups.entry((0, angles)).or_default() += middle * coefficient;
            }
            if radius > 0.0 {
                // No key has this bit.
                *groups.entry((others | 1 << 127, angles)).or_default() += radius * coefficient;
            }
        }
        let mut keys: Vec<(Key, Key)> = groups.keys().copied().collect();
        let mut search = Search { levels: Vec::new(), values: Vec::new(), mass, steps: MOST_STEPS };
        search.values.push(groups.into_values().collect());
        let power = |key: Key, joint: usize| {
            (exponent(key, Variable::Sin, joint), exponent(key, Variable::Cos, joint))
        };
        let degree = |joint: usize, keys: &[(Key, Key)]| {
            let powers = keys.iter().map(|key| power(key.1, joint));
            powers.map(|(sin, cos)| sin + cos).max().unwrap_or(0)
        };
        let mut left: Vec<usize> = (0..ring.angles.len()).collect();
        left.retain(|&joint| degree(joint, &keys) > 0);
        // The last one is the first to be put in: of short ranges, so that the others are
        // not bounded over whole turns of it, then of the highest powers.
        let length = |joint: usize| ring.angles[joint].map_or(f64::MAX, |[low, high]| high - low);
        left.sort_by(|&a, &b| {
            let powers = || degree(a, &keys).cmp(&degree(b, &keys));
            length(b).total_cmp(&length(a)).then_with(powers)
        });
        while let Some(joint) = left.pop() {
            let without = |&(group, angles): &(Key, Key)| {
                let (sin, cos) = power(angles, joint);
                let (sin, cos) = (Key::from(sin), Key::from(cos));
                let taken = key(Variable::Sin, joint) * sin + key(Variable::Cos, joint) * cos;
                (group, angles - taken)
            };
            let mut next: Vec<(Key, Key)> = keys.iter().map(without).collect();
            let targets = next.clone();
            next.sort_unstable();
            next.dedup();
            let mut powers: Vec<(u32, u32)> = keys.iter().map(|key| power(key.1, joint)).collect();
            let each = powers.clone();
            powers.sort_unstable();
            powers.dedup();
            let place = |found: Result<usize, usize>| found.unwrap_or_default() as u32;
            let moves = each.iter().zip(&targets);
            let moves = moves.map(|(own, target)| {
                (place(powers.binary_search(own)), place(next.binary_search(target)))
            });
            search.levels.push(Level {
                degree: f64::from(degree(joint, &keys)),
                range: ring.angles[joint],
                moves: moves.collect(),
                powers,
            });
            search.values.push(vec![0.0; next.len()]);
            keys = next;
        }
        search
    }

    /// Puts an angle in.
    fn fix(&mut self, level: usize, angle: f64) {
        let (sin, cos) = sin_cos(angle);
        let Level { powers, moves, .. } = &self.levels[level];
        let table: Vec<f64> =
            powers.iter().map(|&(s, c)| sin.powi(s as i32) * cos.powi(c as i32)).collect();
        let (before, behind) = self.values.split_at_mut(level + 1);
        let (from, to) = (&before[level], &mut behind[0]);
        to.fill(0.0);
        for (value, &(power, target)) in from.iter().zip(moves) {
            to[target as usize] += value * table[power as usize];
        }
        self.steps = self.steps.saturating_sub(from.len() as u64 + 20);
    }

    fn norm(&self, level: usize) -> f64 {
        self.values[level].iter().map(|value| value.abs()).sum()
    }

    /// A bound of F by amplitudes in the next angle: each coefficient of the level behind
    /// it is a constant and harmonics, of which sine and cosine go together.
    fn amplitudes(&self, level: usize) -> f64 {
        let Some(Level { powers, moves, .. }) = self.levels.get(level) else {
            return f64::INFINITY;
        };
        let mut waves = vec![[0.0f64; 8]; self.values[level + 1].len()];
        for (value, &(power, target)) in self.values[level].iter().zip(moves) {
            let [constant, sin, cos, sin2, cos2, sin3, cos3, other] = &mut waves[target as usize];
            match powers[power as usize] {
                (0, 0) => *constant += value,
                (1, 0) => *sin += value,
                (0, 1) => *cos += value,
                (1, 1) => *sin2 += 0.5 * value,
                (0, 2) => (*constant, *cos2) = (*constant + 0.5 * value, *cos2 + 0.5 * value),
                (1, 2) => (*sin, *sin3) = (*sin + 0.25 * value, *sin3 + 0.25 * value),
                (0, 3) => (*cos, *cos3) = (*cos + 0.75 * value, *cos3 + 0.25 * value),
                _ => *other += value.abs(),
            }
        }
        let size = |&[constant, sin, cos, sin2, cos2, sin3, cos3, other]: &[f64; 8]| {
            let pairs = [(sin, cos), (sin2, cos2), (sin3, cos3)];
            let pairs = pairs.map(|(a, b)| (a * a + b * b).sqrt());
            constant.abs() + pairs.iter().sum::<f64>() + other
        };
        waves.iter().map(size).sum()
    }

    /// Shows that F ≤ B, the angles of the levels before being put in.
    fn shows(&mut self, level: usize, most: f64) -> Result<(), Unshown> {
        let norm = self.norm(level);
        if norm <= most || self.amplitudes(level) <= most {
            return Ok(());
        }
        let Some(Level { degree, range, .. }) = self.levels.get(level) else {
            return Err(Unshown::Larger(norm));
        };
        let (degree, range) = (*degree, *range);
        let mut cells: Vec<(f64, f64)> = Vec::new();
        let [low, high] = range.unwrap_or([-PI, PI]);
        let count = (degree * 0.5 * (high - low) / FIRST_TURN).ceil().max(1.0);
        let half = (0.5 * (high - low) / count).next_up();
        cells.extend((0..count as usize).map(|k| (low + half * (2.0 * k as f64 + 1.0), half)));
        if range.is_some() {
            cells.extend([(low, 0.0), (high, 0.0)]);
        }
        while let Some((middle, half)) = cells.pop() {
            if self.steps == 0 {
                return Err(Unshown::Steps);
            }
            // One part in 10¹² for the roundings of all this.
            let turn = degree * half * (1.0 + 1e-12);
            let below = match range {
                None => most * turn.cos(),
                Some(_) => most - 0.5 * turn * turn * norm,
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

    /// A value that F takes: the largest that is found by turning one angle after the
    /// other from a few places.
    fn climb(&mut self) -> f64 {
        let count = self.levels.len();
        let mut best = 0.0f64;
        for start in 0..12 {
            let mut at: Vec<f64> =
                (0..count).map(|k| ((start * 7 + k * 3) as f64).sin() * PI).collect();
            let mut own = 0.0f64;
            let mut step = 1.0;
            while step > 1e-3 {
                let before = own;
                for k in 0..count {
                    let [low, high] = self.levels[k].range.unwrap_or([-PI, PI]);
                    let from = at[k];
                    for turn in [-4.0, -2.0, -1.0, 0.0, 1.0, 2.0, 4.0] {
                        let kept = at[k];
                        at[k] = (from + step * turn).clamp(low, high);
                        let value = self.value(&at);
                        if value > own { own = value } else { at[k] = kept }
                    }
                }
                if own <= before * 1.0001 {
                    step *= 0.5;
                }
            }
            best = best.max(own);
        }
        best
    }

    /// F at a place.
    fn value(&mut self, at: &[f64]) -> f64 {
        for (level, &angle) in at.iter().enumerate() {
            self.fix(level, angle);
        }
        self.norm(at.len())
    }
}
