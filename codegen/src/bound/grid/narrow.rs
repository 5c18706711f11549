//! Angles of small ranges, written in multiples of another angle that goes
//! round.
//!
//! Between the points of a grid over a part of a circle, a polynomial is bounded by its size over
//! the whole circle, and what is left out of a program for the sake of a narrow box may be a
//! hundred times larger outside the box. So with θ = c + r·cos ψ, which takes every angle of the
//! range, (Jacobi and Anger)
//!
//! - cos(k·r·cos ψ) = J₀ + 2·Σ (−1)^m·J₂ₘ·cos 2mψ, J at k·r
//! - sin(k·r·cos ψ) = 2·Σ (−1)^m·J₂ₘ₊₁·cos (2m + 1)ψ
//!
//! and cos kθ, sin kθ follow by the addition theorems. The box is then all of
//! the circle of ψ, and nothing outside of it counts.
//!
//! **Soundness.** |Jₘ(x)| ≤ (x/2)^m/m!, so what is left of the series is at most a known number for
//! every ψ: it widens the coefficient of cos 0ψ. With it each coefficient contains, state by state,
//! one with which the polynomial has its value; radii are added to every value.

use std::collections::BTreeMap;

use dalembert_model::number::Rational;

use super::harmonics::{bits, multiple};
use crate::bound::expand::{Key, Polynomial, added_up, shift};
use crate::bound::input_box::InputBox;
use crate::interval::Interval;

const MAX_REACH: f64 = 1.25;

const MAX_MULTIPLE: usize = 15;

const REST: f64 = 1e-12;

pub(super) fn narrowed(
    polynomial: Polynomial,
    limits: &InputBox,
    sliding: &[bool],
) -> (Polynomial, Vec<usize>) {
    let mut narrow = Vec::new();
    let mut terms = polynomial;
    for (joint, range) in limits.position.iter().enumerate() {
        let multiples = terms.iter().map(|&(key, _)| multiple(key, joint).0);
        let degree = multiples.max().unwrap_or(0);
        let reach = f64::from(degree) * range.radius();
        if sliding[joint] || degree == 0 || reach.is_nan() || reach > MAX_REACH {
            continue;
        }
        narrow.push(joint);
        terms = pruned(replaced(&terms, joint, *range), limits);
    }
    (terms, narrow)
}

/// The multiples left out come to no more than an allowance: a value may be off by them, and the
/// grid need not be as fine as they would have it.
pub(super) fn cut(
    polynomial: &mut Polynomial,
    narrow: &[usize],
    allowance: f64,
    size: &dyn Fn(&(Key, Interval)) -> f64,
) {
    for &joint in narrow {
        let mut sizes = [0.0; MAX_MULTIPLE + 1];
        for term in polynomial.iter() {
            sizes[multiple(term.0, joint).0 as usize] += size(term);
        }
        let (mut left, mut kept) = (allowance / narrow.len() as f64, MAX_MULTIPLE);
        while kept > 1 && sizes[kept] <= left {
            left -= sizes[kept];
            kept -= 1;
        }
        for (key, x) in polynomial.iter_mut() {
            if multiple(*key, joint).0 as usize > kept {
                *x = Interval::symmetric(x.magnitude());
            }
        }
    }
}

fn replaced(terms: &Polynomial, joint: usize, range: Interval) -> Polynomial {
    let mut series: BTreeMap<(u32, bool), Vec<Interval>> = BTreeMap::new();
    let mut next = Polynomial::new();
    for &(key, x) in terms {
        let of = multiple(key, joint);
        let rest = key & !bits(joint);
        if of.0 == 0 {
            next.push((key, x));
            continue;
        }
        let series = series.entry(of).or_insert_with(|| of_multiple(of, range));
        for (m, &part) in (0..).zip(series.iter()) {
            if part != Interval::ZERO {
                next.push((rest | (m as Key) << shift(joint), x * part));
            }
        }
    }
    added_up(next)
}

/// Terms smaller than this part of the largest are put together: what is left of
/// five series would be a hundred times more terms than count.
const SMALL: f64 = 1e-9;

/// Adds small terms to the error of their rates' coefficient without angles.
fn pruned(terms: Polynomial, limits: &InputBox) -> Polynomial {
    let size = |&(key, x): &(Key, Interval)| x.magnitude() * super::range(key, limits).magnitude();
    let least = SMALL * terms.iter().map(size).fold(0.0, f64::max);
    let (small, mut kept): (Polynomial, Polynomial) =
        terms.into_iter().partition(|term| size(term) <= least);
    let mut off: BTreeMap<Key, f64> = BTreeMap::new();
    for (key, x) in small {
        let sum = off.entry(key & 0xffff).or_insert(0.0);
        *sum = (*sum + x.magnitude()).next_up();
    }
    for (key, radius) in off {
        match kept.binary_search_by_key(&key, |term| term.0) {
            Ok(place) => kept[place].1 = kept[place].1.widened(radius),
            Err(place) => kept.insert(place, (key, Interval::symmetric(radius))),
        }
    }
    kept
}

fn of_multiple((k, sine): (u32, bool), range: Interval) -> Vec<Interval> {
    let k = Interval::point(f64::from(k));
    let centre = k * Interval::point(range.mid());
    let reach = k * Interval::point(range.radius());
    let (even, odd) = match sine {
        true => (centre.sin(), centre.cos()),
        false => (centre.cos(), -centre.sin()),
    };
    let mut parts = Vec::new();
    for m in 0..=MAX_MULTIPLE {
        let size = if m == 0 { 1.0 } else { 2.0 };
        let sign = if m / 2 % 2 == 0 { size } else { -size };
        let factor = if m % 2 == 0 { even } else { odd };
        parts.push(bessel(m, reach) * factor * Interval::point(sign));
        if 2.0 * largest(m + 1, reach.high()) < REST {
            break;
        }
    }
    // Each further term is less than half of the one before.
    let rest = 4.0 * largest(parts.len(), reach.high());
    parts[0] = parts[0].widened(rest);
    parts
}

/// Returns a bound of |Jₘ(x)|: (x/2)^m/m!.
fn largest(m: usize, x: f64) -> f64 {
    (1..=m).fold(1.0, |product, i| product * x / (2.0 * i as f64)) * (1.0 + 1e-12)
}

/// Returns Jₘ(x) = Σ (−1)^i·(x/2)^(2i+m)/(i!·(i+m)!) for x up to 2: the terms alternate
/// and shrink, so what is left out is at most the first term of it.
fn bessel(m: usize, x: Interval) -> Interval {
    let half = x * Interval::point(0.5);
    let over = |n: usize| Interval::rational(&Rational::new(1.into(), n.into()));
    let mut term = (1..=m).fold(Interval::ONE, |term, i| term * half * over(i));
    let mut sum = Interval::ZERO;
    let mut i = 0;
    while term.magnitude() > 1e-19 {
        sum = if i % 2 == 0 { sum + term } else { sum - term };
        i += 1;
        term = term * half * half * over(i) * over(i + m);
    }
    sum.widened(term.magnitude())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bound::expand::rates;
    use crate::random::Random;

    #[test]
    fn a_narrow_range_is_written_without_a_loss() {
        let mut random = Random::new(7);
        for _ in 0..200 {
            let low = 6.0 * (random.unit() - 0.5);
            let range = Interval::new(low, low + 0.8 * random.unit()).unwrap();
            for k in 1..=3 {
                for sine in [false, true] {
                    let series = of_multiple((k, sine), range);
                    for step in 0..=50 {
                        let psi = std::f64::consts::PI * f64::from(step) / 50.0;
                        let angle = range.mid() + range.radius() * libm::cos(psi);
                        let angle = f64::from(k) * angle;
                        let value = if sine {
                            libm::sin(angle)
                        } else {
                            libm::cos(angle)
                        };
                        let terms = series.iter().enumerate();
                        let sum: f64 = terms
                            .map(|(m, x)| x.mid() * libm::cos(m as f64 * psi))
                            .sum();
                        let radii: f64 = series.iter().map(|x| x.radius()).sum();
                        assert!((sum - value).abs() <= radii + 1e-14, "{k} {sine} {range:?}");
                        assert!(radii < 1e-10);
                    }
                }
            }
        }
    }

    #[test]
    fn only_angles_of_narrow_ranges_are_replaced() {
        let limits = InputBox::symmetric(&[3.0, 0.2], &[1.0; 2], &[1.0; 2]);
        let key: Key = 1 << shift(0) | 17 << shift(1) | 2;
        let (terms, narrow) = narrowed(vec![(key, Interval::ONE)], &limits, &[false, false]);
        assert_eq!(narrow, [1]);
        for (key, x) in terms {
            if x.mid() != 0.0 {
                assert_eq!((multiple(key, 0), rates(key)), ((1, false), [0, 2]));
            }
            assert!(!multiple(key, 1).1);
        }
    }
}
