//! The largest magnitude of a trigonometric polynomial over a box, from its
//! values at points that lie close where it is large.
//!
//! **Soundness.** Let |T| be largest, M, at x₀ and some rates; hold these
//! rates. Of the first angle's cells one contains x₀'s; c is its middle, δ its
//! half width, d the degree of T in that angle.
//!
//! - *Whole circle.* M. Riesz: |T(c, x₀₂, …)| ≥ M·cos(d·δ) for d·δ ≤ π/2. So
//!   M ≤ m(c)/cos(d·δ), m(c) being the maximum over the other angles at c.
//! - *Part of it.* The ends are points of their own. If x₀ is at an end,
//!   nothing is lost; if not, ∂T(x₀) = 0, |∂²T| ≤ d²·F with F the largest
//!   value over whole circles (Bernstein), and M ≤ m(c) + ½(d·δ)²·F.
//!
//! So M ≤ B is shown by showing m(c) ≤ B·cos(d·δ) for every cell, angle after
//! angle; a cell for which that fails is cut in three. The first B that is
//! tried is a value that T takes and a little more. For each point the rates
//! are at their worst, monomial by monomial.
//!
//! What the arithmetic costs: coefficients are intervals, of which the points
//! take the middle; their radii are added to each value, and so is
//! [`SLACK`] times the sum of all |coefficient · monomial|, which covers the
//! few dozen roundings between a coefficient and a value, since every sine and
//! cosine is at most 1.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use super::expand::{Key, Polynomial, powers, rates};
use super::input_box::InputBox;
use super::interval::Interval;

/// More than a hundred roundings of double precision, relative.
const SLACK: f64 = 1e-13;

/// What a bound exceeds a value that is taken by, relative.
const CLOSE: f64 = 0.02;

/// d·δ of the first cells is π over this.
const FIRST: usize = 8;

/// Cells whose d·δ is below this are not cut: with four angles their cosines
/// take 1.6 of the two hundredths.
const FINEST: f64 = 0.09;

/// Places to climb from.
const STARTS: usize = 12;

/// Largest magnitudes of polynomials over a box, no closer than `goals` where
/// they are smaller; `None` if even the first
/// cells have more points than allowed.
pub(super) fn magnitudes(
    polynomials: &[Polynomial],
    limits: &InputBox,
    sliding: &[bool],
    goals: &[f64],
    points: usize,
) -> Option<Vec<f64>> {
    polynomials
        .iter()
        .zip(goals)
        .map(|(polynomial, &goal)| {
            let layout = Layout::new(polynomial, limits, sliding);
            let first = layout.degrees.iter().map(|&d| (FIRST * d as usize) as f64);
            if first.product::<f64>() > points as f64 {
                return None;
            }
            let whole = layout.bound(limits, None, goal, points);
            if !layout.part.contains(&true) {
                return Some(whole);
            }
            Some(whole.min(layout.bound(limits, Some(whole), goal, points)))
        })
        .collect()
}

/// Terms regrouped so that a grid is evaluated joint after joint.
struct Layout {
    joints: Vec<usize>,
    degrees: Vec<u32>,
    /// Of each joint: the powers (cosine, sine) that occur.
    bases: Vec<Vec<(u32, u32)>>,
    coefficients: Vec<f64>,
    /// Of each joint: (from, base, to), and how many values come out.
    folds: Vec<(Vec<[u32; 3]>, usize)>,
    /// Of each joint: the largest magnitude of the rates of each value that
    /// goes in.
    sizes: Vec<Vec<f64>>,
    /// The range of the rates of each value that comes out.
    output: Vec<(f64, f64)>,
    slack: f64,
    /// Whether a joint has less than the whole circle.
    part: Vec<bool>,
}

/// One bound in the making.
struct Work {
    buffers: Vec<Vec<f64>>,
    /// F, if the box is a part of the circles.
    whole: Option<f64>,
    ranges: Vec<Interval>,
    points: usize,
}

impl Layout {
    fn new(polynomial: &Polynomial, limits: &InputBox, sliding: &[bool]) -> Layout {
        let degree = |joint: usize| {
            let keys = polynomial
                .iter()
                .filter(|&&(key, x)| negligible(x, key, limits).is_none())
                .map(|&(key, _)| powers(key, joint));
            keys.map(|(c, s)| c + s).max().unwrap_or(0)
        };
        let mut joints: Vec<usize> = (0..limits.joints()).filter(|&j| degree(j) > 0).collect();
        // The joint of the highest degree last: its sums are the shortest.
        joints.sort_by_key(|&joint| degree(joint));
        let degrees: Vec<u32> = joints.iter().map(|&j| degree(j)).collect();
        let part = joints
            .iter()
            .map(|&j| !sliding[j] && limits.position[j].width() < 2.0 * PI * (1.0 - 1e-12))
            .collect();
        let mut bases: Vec<Vec<(u32, u32)>> = vec![Vec::new(); joints.len()];
        let mut terms: Vec<Key> = Vec::new();
        let mut coefficients = Vec::new();
        let mut slack = 0.0;
        for &(key, coefficient) in polynomial {
            if let Some(lost) = negligible(coefficient, key, limits) {
                slack += lost;
                continue;
            }
            let most = range(key, limits).magnitude();
            let size = coefficient.magnitude() * most;
            slack += (coefficient.radius() * most + SLACK * size) * (1.0 + 1e-9);
            terms.push(key);
            coefficients.push(coefficient.mid());
        }
        let mut sizes = Vec::new();
        let mut folds = Vec::new();
        for (k, &joint) in joints.iter().enumerate() {
            sizes.push(
                terms
                    .iter()
                    .map(|&key| range(key, limits).magnitude())
                    .collect(),
            );
            let mut places: BTreeMap<Key, u32> = BTreeMap::new();
            let mut fold = Vec::new();
            for (from, &key) in terms.iter().enumerate() {
                let power = powers(key, joint);
                let base = bases[k]
                    .iter()
                    .position(|&b| b == power)
                    .unwrap_or_else(|| {
                        bases[k].push(power);
                        bases[k].len() - 1
                    });
                let rest = key & !(31u128 << (16 + 5 * joint));
                let next = places.len() as u32;
                let to = *places.entry(rest).or_insert(next);
                fold.push([from as u32, base as u32, to]);
            }
            terms = vec![0; places.len()];
            for (term, place) in places {
                terms[place as usize] = term;
            }
            folds.push((fold, terms.len()));
        }
        let output = terms.iter().map(|&key| {
            let range = range(key, limits);
            (range.low(), range.high())
        });
        Layout {
            output: output.collect(),
            joints,
            degrees,
            bases,
            coefficients,
            folds,
            sizes,
            slack,
            part,
        }
    }

    /// A bound over the whole circles, or, given that, over the box.
    fn bound(&self, limits: &InputBox, whole: Option<f64>, goal: f64, points: usize) -> f64 {
        let mut buffers: Vec<Vec<f64>> = vec![self.coefficients.clone()];
        buffers.extend(self.folds.iter().map(|(_, len)| vec![0.0; *len]));
        let mut work = Work {
            buffers,
            whole,
            ranges: self.joints.iter().map(|&j| limits.position[j]).collect(),
            points,
        };
        let least = self.climb(&mut work);
        let crude = self.crude(0, &work);
        let mut bound = (least * (1.0 + CLOSE)).max(goal) + 2.0 * self.slack;
        let mut more = 2.0 * CLOSE;
        while bound < crude {
            work.points = points;
            if self.below(0, bound, &mut work) {
                return bound;
            }
            bound *= 1.0 + more;
            more *= 2.0;
        }
        crude
    }

    /// No sine is larger than one.
    fn crude(&self, level: usize, work: &Work) -> f64 {
        // After the last angle only rates are left.
        let Some(sizes) = self.sizes.get(level) else {
            return self.value(&work.buffers[level]) * (1.0 + 1e-9);
        };
        let terms = work.buffers[level].iter().zip(sizes);
        terms.fold(self.slack, |sum, (x, size)| sum + x.abs() * size) * (1.0 + 1e-9)
    }

    /// Puts an angle into the values before a joint.
    fn fold(&self, level: usize, angle: f64, buffers: &mut [Vec<f64>]) {
        let (sin, cos) = libm::sincos(angle);
        let power = |&(c, s): &(u32, u32)| {
            (0..c).fold(1.0, |x, _| x * cos) * (0..s).fold(1.0, |x, _| x * sin)
        };
        let row: Vec<f64> = self.bases[level].iter().map(power).collect();
        let (from, rest) = buffers.split_at_mut(level + 1);
        rest[0].fill(0.0);
        for &[x, base, to] in &self.folds[level].0 {
            rest[0][to as usize] += from[level][x as usize] * row[base as usize];
        }
    }

    /// The value at a point, rates at their worst.
    fn value(&self, values: &[f64]) -> f64 {
        let (mut low, mut high) = (0.0, 0.0);
        for (x, &(least, greatest)) in values.iter().zip(&self.output) {
            let (a, b) = (x * least, x * greatest);
            low += a.min(b);
            high += a.max(b);
        }
        f64::max(high, -low) + self.slack
    }

    /// The joint's range, unless it goes round.
    fn part(&self, level: usize, work: &Work) -> Option<(Interval, f64)> {
        let whole = work.whole.filter(|_| self.part[level])?;
        Some((work.ranges[level], whole))
    }

    /// Whether the maximum over the joints from `level` on is at most a bound:
    /// `true` is a proof.
    fn below(&self, level: usize, bound: f64, work: &mut Work) -> bool {
        if level == self.folds.len() {
            work.points = work.points.saturating_sub(1);
            return self.value(&work.buffers[level]) <= bound;
        }
        if self.crude(level, work) <= bound {
            return true;
        }
        if bound <= 0.0 || work.points == 0 {
            return false;
        }
        let degree = f64::from(self.degrees[level]);
        let part = self.part(level, work);
        let count = FIRST * self.degrees[level] as usize;
        let (from, width) = match part {
            Some((range, _)) => {
                for end in [range.low(), range.high()] {
                    self.fold(level, end, &mut work.buffers);
                    if !self.below(level + 1, bound, work) {
                        return false;
                    }
                }
                (range.low(), range.width())
            }
            None => (0.0, 2.0 * PI),
        };
        let half = 0.5 * width / count as f64;
        let middle = |k: usize| from + width * (k as f64 + 0.5) / count as f64;
        let mut cells: Vec<(f64, f64)> = (0..count).rev().map(|k| (middle(k), half)).collect();
        while let Some((angle, half)) = cells.pop() {
            // Half widths are rounded; a little more covers that.
            let reach = degree * half * (1.0 + 1e-12);
            let enough = match part {
                Some((_, whole)) => {
                    (bound - 0.5 * reach * reach * whole * (1.0 + 1e-12)).next_down()
                }
                None => (bound * (libm::cos(reach) - 1e-15)).next_down(),
            };
            self.fold(level, angle, &mut work.buffers);
            if !self.below(level + 1, enough, work) {
                if reach <= FINEST || work.points == 0 {
                    return false;
                }
                let third = half / 3.0;
                cells.extend([-2.0, 0.0, 2.0].map(|k| (angle + k * third, third)));
            }
        }
        true
    }

    /// A value that is taken: the largest of a coarse grid, climbed from.
    fn climb(&self, work: &mut Work) -> f64 {
        let count = self.joints.len();
        let span = |level: usize, work: &Work| match self.part(level, work) {
            Some((range, _)) => (range.low(), range.high()),
            None => (0.0, 2.0 * PI),
        };
        let at = |angles: &[f64], work: &mut Work| {
            for (level, &angle) in angles.iter().enumerate() {
                self.fold(level, angle, &mut work.buffers);
            }
            self.value(&work.buffers[count]) - self.slack
        };
        let mut best = 0.0;
        let mut random = crate::simplify::random::Random::new(0x9d1d);
        for _ in 0..STARTS {
            let mut angles: Vec<f64> = (0..count)
                .map(|level| {
                    let (low, high) = span(level, work);
                    low + (high - low) * random.unit()
                })
                .collect();
            let mut value = at(&angles, work);
            let mut step = 0.7;
            while step > 1e-3 {
                let mut moved = false;
                for level in 0..count {
                    let (low, high) = span(level, work);
                    for sign in [-1.0, 1.0] {
                        let old = angles[level];
                        angles[level] = match self.part(level, work) {
                            Some(_) => (old + sign * step).clamp(low, high),
                            None => old + sign * step,
                        };
                        let next = at(&angles, work);
                        if next > value {
                            (value, moved) = (next, true);
                        } else {
                            angles[level] = old;
                        }
                    }
                }
                if !moved {
                    step *= 0.4;
                }
            }
            best = f64::max(best, value);
        }
        best
    }
}

/// What a term can be at most, if it is but the rounding of a sum that
/// cancels: zero is inside, and it is far below what counts.
fn negligible(coefficient: Interval, key: Key, limits: &InputBox) -> Option<f64> {
    let most = (coefficient.magnitude() * range(key, limits).magnitude()).next_up();
    (coefficient.contains(0.0) && most < 1e-13).then_some(most)
}

/// The range of a key's rates.
fn range(key: Key, limits: &InputBox) -> Interval {
    let n = limits.joints();
    let variable = |rate: u8| match usize::from(rate) {
        0 => Interval::ONE,
        k if k <= n => limits.velocity[k - 1],
        k => limits.acceleration[k - 1 - n],
    };
    match rates(key) {
        [a, b] if a == b && a != 0 => variable(a).square(),
        [0, 0] => Interval::ONE,
        [0, b] => variable(b),
        [a, b] => variable(a) * variable(b),
    }
}
