//! The largest magnitude of a trigonometric polynomial over a box, from its
//! values at points that lie close where it is large.
//!
//! **Soundness.** Let |T| be largest, M, at x₀ and some rates; hold these rates. Of the first
//! angle's cells one contains x₀'s; c is its middle, δ its half width, d the degree of T in that
//! angle. The angle is at x₀ where T's derivative by it is 0, unless that is an end of its range.
//!
//! - *Whole circle.* M. Riesz: |T(c, x₀₂, …)| ≥ M·cos(d·δ) for d·δ ≤ π/2. So
//!   M ≤ m(c)/cos(d·δ), m(c) being the maximum over the other angles at c.
//! - *Anywhere.* M ≤ m(c) + ½δ²·K with K ≥ |∂²T|: each multiple k of the angle by itself, k² times
//!   what it is without looking at the angles that are left. Most multiples are small, and of those
//!   angles that were put in K knows the values, so that it is mostly far below M·d².
//! - *Ends* of a part of the circle are points of their own.
//!
//! So M ≤ B is shown by showing m(c) ≤ max(B·cos(d·δ), B − ½δ²·K) for every cell, angle after
//! angle; a cell for which that fails is cut in three. Every B that is tried is a value that T
//! takes and a little more. For each point the rates are at their worst: accelerations and squares
//! one by one, products of velocities together ([`corners`](super::corners)).
//!
//! What the arithmetic costs: coefficients are intervals, of which the points
//! take the middle; their radii are added to each value, and so is what
//! rounding costs on the way from coefficients to a value (`layout`).
//!
//! - `narrow`: angles of small ranges, written in multiples of another that goes round
//! - `harmonics`: multiples of angles in place of powers
//! - `layout`: terms regrouped so that points are quick
//! - `cells`: the bound; where sines cannot make up the difference any more, no angle is looked at
//! - [`least_eigenvalue`]: the same for a symmetric matrix

mod cells;
mod definite;
mod harmonics;
mod layout;
mod narrow;

use crate::bound::expand::{Key, Polynomial, rates};
use crate::bound::input_box::InputBox;
use crate::dag::{Dag, Node};
use crate::function::Argument;
use crate::interval::Interval;
use crate::program::Input;
use crate::random::Random;
use cells::Cells;
pub(super) use definite::{Wanted, least_eigenvalue};
pub(super) use harmonics::harmonics;
use layout::Layout;
use narrow::narrowed;

/// Terms smaller than this part of the largest are not looked at one by one: most are what rounding
/// left of terms that cancel, and would make the degree higher.
const NEGLIGIBLE: f64 = 1e-8;

/// What the highest multiples of narrow angles may come to, against what a bound
/// may exceed a value by.
const CUT: f64 = 0.3;

const LEAST: f64 = 1e-15;

const MAX_STEP: f64 = 0.15;

/// Cells that cost less than this part of a bound are not cut: with four angles they take
/// 1.6 of the two hundredths.
const FINEST: f64 = 0.004;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct GridEffort {
    pub points: usize,
    /// What a bound exceeds a value that is taken by, relative.
    pub close: f64,
    pub starts: usize,
}

impl GridEffort {
    pub(super) fn fine(points: usize) -> GridEffort {
        GridEffort {
            points,
            close: 0.02,
            starts: 12,
        }
    }
}

pub(super) fn sliding(graph: &Dag, joints: usize) -> Vec<bool> {
    let mut sliding = vec![false; joints];
    for node in &graph.nodes {
        if let Node::Input(Input::Entry(Argument::Position, joint)) = node {
            sliding[*joint] = true;
        }
    }
    sliding
}

/// Over whole circles, the bounds that are tried do not depend on it: a bound shown for one aim is
/// shown again for another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Aim {
    Least,
    Within(f64),
    /// At most this, which need not be smaller than [`ENOUGH`] of it; or, where that cannot
    /// be shown, about the largest value that is taken, as a number above it.
    Judged(f64),
}

const ENOUGH: f64 = 0.85;

pub(super) fn magnitude(
    polynomial: Polynomial,
    limits: &InputBox,
    sliding: &[bool],
    aim: Aim,
    closeness: GridEffort,
) -> f64 {
    let range = |key: Key| range(key, limits);
    let (mut polynomial, narrow) = narrowed(polynomial, limits, sliding);
    let sliding: Vec<bool> = (0..sliding.len())
        .map(|joint| sliding[joint] || narrow.contains(&joint))
        .collect();
    let size = |&(key, x): &(Key, Interval)| x.magnitude() * range(key).magnitude();
    let least = NEGLIGIBLE * polynomial.iter().map(size).fold(0.0, f64::max);
    let mut layout = Layout::new(&polynomial, limits, &sliding, &range, least);
    if !narrow.is_empty() && closeness.points > 0 {
        let mut cells = Cells::new(&layout, limits, None, &|_, _| false);
        cells.points = closeness.points;
        let taken = climb(&mut cells, closeness.starts, &|values| layout.value(values));
        let allowance = CUT * closeness.close * taken;
        narrow::cut(&mut polynomial, &narrow, allowance, &size);
        layout = Layout::new(&polynomial, limits, &sliding, &range, least);
    }
    bound(&layout, limits, aim, closeness)
}

fn bound(layout: &Layout, limits: &InputBox, aim: Aim, closeness: GridEffort) -> f64 {
    let points = closeness.points;
    let crude = layout.crude(0, &layout.coefficients).most;
    let goal = match aim {
        Aim::Least => 0.0,
        Aim::Within(most) => most,
        Aim::Judged(most) => ENOUGH * most,
    };
    if points == 0 || crude <= goal {
        return crude;
    }
    let accept = |values: &[f64], bound| layout.is_below(values, bound);
    let mut cells = Cells::new(layout, limits, Some(crude), &accept);
    cells.is_sum = true;
    cells.points = points;
    let value = |values: &[f64]| layout.value(values) - layout.slack;
    let least = climb(&mut cells, closeness.starts, &value);
    let tries = tries(least, 2.0 * layout.slack, crude, closeness.close);
    let mut shown = |bound: f64| {
        cells.points = points;
        least <= bound && bound < crude && cells.below(0, bound)
    };
    let mut ascending = tries.iter().copied();
    let (first, most) = match aim {
        Aim::Least => {
            return match ascending.next().filter(|&bound| shown(bound)) {
                Some(bound) => bound,
                None => least_shown(&tries, &mut shown).unwrap_or(crude),
            };
        }
        Aim::Judged(most) => (ascending.find(|&bound| bound >= goal), most),
        Aim::Within(most) => (ascending.rfind(|&bound| bound <= most), most),
    };
    // Between two of them, what is asked for may be shown where the smaller one is not.
    let first = first.filter(|&bound| bound < most);
    let found = first.into_iter().chain([most]).find(|&bound| shown(bound));
    let above = match aim {
        Aim::Judged(..) => f64::max(least * (1.0 + closeness.close), most.next_up()),
        _ => crude,
    };
    found.unwrap_or(above.min(crude))
}

fn tries(taken: f64, slack: f64, crude: f64, close: f64) -> Vec<f64> {
    let mut tries = Vec::new();
    let mut more = close;
    // From so far below the crude bound that no smaller one matters, and a step up is one.
    let mut next = (taken * (1.0 + more) + slack).max(LEAST * crude);
    while f64::MIN_POSITIVE < next && next < crude {
        tries.push(next);
        more = (2.0 * more).min(MAX_STEP);
        next *= 1.0 + more;
    }
    tries
}

/// The first bound was not shown. A larger one takes fewer points, so halving finds the least.
fn least_shown(tries: &[f64], shown: &mut dyn FnMut(f64) -> bool) -> Option<f64> {
    let (mut failed, mut held) = (0, tries.len());
    while held > failed + 1 {
        let middle = (failed + held) / 2;
        if shown(tries[middle]) {
            held = middle;
        } else {
            failed = middle;
        }
    }
    tries.get(held).copied()
}

fn climb(cells: &mut Cells<'_>, starts: usize, value: &dyn Fn(&[f64]) -> f64) -> f64 {
    let count = cells.layout.joints.len();
    // The first angles of which the values are still there need not be put in;
    // they count all the same: points say where a climb ends, not how it is done.
    let at = |angles: &[f64], known: usize, cells: &mut Cells<'_>| {
        for (level, &angle) in angles.iter().enumerate() {
            cells.charge(level);
            if level >= known {
                cells.place(level, angle);
            }
        }
        value(cells.values(count))
    };
    let mut best = 0.0;
    let mut random = Random::new(0x9d1d);
    for _ in 0..starts {
        let mut angles: Vec<f64> = (0..count)
            .map(|level| {
                let (low, width) = cells.span(level);
                low + width * random.unit()
            })
            .collect();
        let (mut highest, mut known) = (at(&angles, 0, cells), count);
        let mut step = 0.7;
        while step > 1e-3 && cells.points > 0 {
            let mut moved = false;
            for level in 0..count {
                for sign in [-1.0, 1.0] {
                    let old = angles[level];
                    angles[level] = match cells.part(level) {
                        Some((range, _)) => (old + sign * step).clamp(range.low(), range.high()),
                        None => old + sign * step,
                    };
                    let next = at(&angles, known.min(level), cells);
                    if next > highest {
                        (highest, moved, known) = (next, true, count);
                    } else {
                        (angles[level], known) = (old, level);
                    }
                }
            }
            if !moved {
                step *= 0.4;
            }
        }
        best = f64::max(best, highest);
    }
    best
}

fn range(key: Key, limits: &InputBox) -> Interval {
    match rates(key) {
        [a, b] if a == b && a != 0 => limits.rate(a).square(),
        [0, b] => limits.rate(b),
        [a, b] => limits.rate(a) * limits.rate(b),
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::harmonics::multiple;
    use super::*;
    use crate::bound::expand::shift;

    #[test]
    fn bounds_of_small_high_multiples_are_tight() {
        let mut random = Random::new(11);
        for round in 0..12 {
            let reach = if round % 2 == 0 { PI } else { 1.9 };
            let limits = InputBox::symmetric(&[reach; 2], &[2.0; 2], &[3.0; 2]);
            let mut terms = Polynomial::new();
            for rates in [1 << 8 | 2, 2, 3] {
                for first in 0..=4u32 {
                    for second in 0..=4u32 {
                        for phase in 0..4u32 {
                            let key = (first | (phase & 1) << 4, second | (phase >> 1) << 4);
                            if (first == 0 && key.0 != 0) || (second == 0 && key.1 != 0) {
                                continue;
                            }
                            let size = 0.2f64.powi((first + second) as i32);
                            let x = Interval::point(size * (random.unit() - 0.5));
                            let angles =
                                Key::from(key.0) << shift(0) | Key::from(key.1) << shift(1);
                            terms.push((angles | rates, x));
                        }
                    }
                }
            }
            terms.sort_by_key(|&(key, _)| key);
            let value = |angles: [f64; 2]| {
                let mut parts = [0.0; 3];
                for &(key, x) in &terms {
                    let factors = angles.iter().enumerate().map(|(joint, angle)| {
                        let (k, sine) = multiple(key, joint);
                        let angle = f64::from(k) * angle;
                        if sine {
                            libm::sin(angle)
                        } else {
                            libm::cos(angle)
                        }
                    });
                    let place = match key & 0xffff {
                        0x102 => 0,
                        2 => 1,
                        _ => 2,
                    };
                    parts[place] += x.mid() * factors.product::<f64>();
                }
                4.0 * parts[0].abs() + 2.0 * parts[1].abs() + 3.0 * parts[2].abs()
            };
            let at = |k: i32| reach * f64::from(k) / 60.0;
            let grid = (-60..=60).flat_map(|a| (-60..=60).map(move |b| [at(a), at(b)]));
            let most = grid.map(value).fold(0.0, f64::max);
            let effort = GridEffort::fine(1 << 20);
            let found = magnitude(terms.clone(), &limits, &[false; 2], Aim::Least, effort);
            assert!((most..1.05 * most).contains(&found), "{most} {found}");
        }
    }
}
