//! Intervals of doubles, rounded outward.
//!
//! **Soundness.** IEEE arithmetic rounds to nearest: the exact result of one operation lies between
//! the doubles next to the computed one on either side. Every operation here computes its ends to
//! nearest and then moves each outward by one double, so the interval contains the exact result of
//! every choice of operands in the operands' intervals. An end that overflows becomes infinite; a
//! NaN (∞ − ∞ or 0 · ∞) becomes the whole line, which says nothing and is therefore true.

use dalembert_model::number::{Rational, Rounded};
use dalembert_model::scalar::{Divide, Scalar};

/// All numbers from `low` to `high`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    low: f64,
    high: f64,
}

impl Interval {
    pub const ZERO: Interval = Interval::point(0.0);
    pub const ONE: Interval = Interval::point(1.0);
    pub const ALL: Interval = Interval {
        low: f64::NEG_INFINITY,
        high: f64::INFINITY,
    };

    pub const fn point(x: f64) -> Interval {
        Interval { low: x, high: x }
    }

    /// Makes the interval from one end to the other; `None` if they are out of order or NaN.
    pub fn new(low: f64, high: f64) -> Option<Interval> {
        (low <= high).then_some(Interval { low, high })
    }

    /// Returns −x to x for x = |`radius`|.
    pub fn symmetric(radius: f64) -> Interval {
        checked(-radius.abs(), radius.abs())
    }

    /// Returns an enclosure of a rational: a point if a double holds it.
    pub fn rational(value: &Rational) -> Interval {
        let near = f64::nearest_rational(value);
        if Rational::from_float(near).as_ref() == Some(value) {
            Interval::point(near)
        } else {
            checked(near.next_down(), near.next_up())
        }
    }

    pub fn low(self) -> f64 {
        self.low
    }

    pub fn high(self) -> f64 {
        self.high
    }

    pub fn magnitude(self) -> f64 {
        self.low.abs().max(self.high.abs())
    }

    /// Returns a number inside, near the middle.
    pub fn mid(self) -> f64 {
        (0.5 * self.low + 0.5 * self.high).clamp(self.low, self.high)
    }

    /// Returns at least half the width, seen from [`mid`](Self::mid).
    pub fn radius(self) -> f64 {
        let mid = self.mid();
        (mid - self.low).max(self.high - mid).next_up()
    }

    pub fn width(self) -> f64 {
        self.high - self.low
    }

    pub fn contains(self, x: f64) -> bool {
        self.low <= x && x <= self.high
    }

    pub fn square(self) -> Interval {
        let least = match self.contains(0.0) {
            true => 0.0,
            false => self.low.abs().min(self.high.abs()),
        };
        let most = self.magnitude();
        let low = (least * least).next_down().max(0.0);
        checked(low, (most * most).next_up())
    }

    /// Returns x widened by a number on both sides.
    pub fn widened(self, by: f64) -> Interval {
        self + Interval::symmetric(by)
    }
}

fn checked(low: f64, high: f64) -> Interval {
    if low <= high {
        Interval { low, high }
    } else {
        Interval::ALL
    }
}

/// Returns the least interval around numbers that were rounded to nearest.
#[inline]
fn around([a, b, c, d]: [f64; 4]) -> Interval {
    // `min` and `max` drop a NaN; the sum does not.
    if (a + b + c + d).is_nan() {
        return Interval::ALL;
    }
    let (low, high) = (a.min(b).min(c.min(d)), a.max(b).max(c.max(d)));
    checked(low.next_down(), high.next_up())
}

impl core::ops::Add for Interval {
    type Output = Interval;
    #[inline]
    fn add(self, other: Interval) -> Interval {
        let (low, high) = (self.low + other.low, self.high + other.high);
        checked(low.next_down(), high.next_up())
    }
}

impl core::ops::Sub for Interval {
    type Output = Interval;
    #[inline]
    fn sub(self, other: Interval) -> Interval {
        let (low, high) = (self.low - other.high, self.high - other.low);
        checked(low.next_down(), high.next_up())
    }
}

impl core::ops::Mul for Interval {
    type Output = Interval;
    #[inline]
    fn mul(self, other: Interval) -> Interval {
        // Zero times anything is zero: an unbounded operand is still made of numbers.
        if self == Interval::ZERO || other == Interval::ZERO {
            return Interval::ZERO;
        }
        around([
            self.low * other.low,
            self.low * other.high,
            self.high * other.low,
            self.high * other.high,
        ])
    }
}

impl core::ops::Neg for Interval {
    type Output = Interval;
    fn neg(self) -> Interval {
        checked(-self.high, -self.low)
    }
}

impl Scalar for Interval {
    fn zero() -> Self {
        Interval::ZERO
    }
    fn one() -> Self {
        Interval::ONE
    }
    fn add(&self, other: &Self) -> Self {
        *self + *other
    }
    fn sub(&self, other: &Self) -> Self {
        *self - *other
    }
    fn mul(&self, other: &Self) -> Self {
        *self * *other
    }
    fn neg(&self) -> Self {
        -*self
    }
    fn half(&self) -> Self {
        *self * Interval::point(0.5)
    }
    fn is_zero(&self) -> bool {
        *self == Interval::ZERO
    }
}

impl Divide for Interval {
    /// Returns every number where the divisor may vanish: there is no quotient then.
    fn div(&self, other: &Self) -> Self {
        if other.contains(0.0) {
            return Interval::ALL;
        }
        // Correctly rounded like products: one double outward encloses.
        around([
            self.low() / other.low(),
            self.low() / other.high(),
            self.high() / other.low(),
            self.high() / other.high(),
        ])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::program::Operation;
    use crate::random::Random;

    fn ratio(n: i64, d: i64) -> Rational {
        Rational::new(n.into(), d.into())
    }

    fn end(x: f64) -> Rational {
        Rational::from_float(x).unwrap()
    }

    #[test]
    fn rationals_and_squares_are_contained() {
        for (n, d) in [(1, 3), (-2, 7), (5, 1), (-1, 10), (123_456, 789)] {
            let a = ratio(n, d);
            let x = Interval::rational(&a);
            for (x, a) in [(x, a.clone()), (x.square(), &a * &a)] {
                assert!(end(x.low) <= a && a <= end(x.high));
            }
        }
    }

    #[test]
    fn a_point_loses_at_most_an_ulp_on_each_side() {
        let third = Interval::rational(&ratio(1, 3));
        assert!(third.low < third.high && third.width() < 2e-16);
        let sum = Interval::point(0.1) + Interval::point(0.2);
        assert!(sum.width() < 2e-16);
        assert_eq!(Interval::rational(&ratio(1, 4)), Interval::point(0.25));
    }

    #[test]
    fn what_is_no_number_says_nothing() {
        let big = Interval::point(f64::MAX);
        let over = big + big;
        assert_eq!(over.high, f64::INFINITY);
        assert_eq!(over - over, Interval::ALL);
        assert_eq!(Interval::ZERO * Interval::ALL, Interval::ZERO);
        assert_eq!(Interval::new(1.0, 0.0), None);
        assert_eq!(Interval::new(f64::NAN, 0.0), None);
    }

    #[test]
    fn results_enclose_exact_results() {
        let mut random = Random::new(0x1e7);
        let mut number = || {
            let scale = libm::exp2((random.bits() % 40) as f64 - 20.0);
            (random.bits() % 2001) as f64 * scale / 1000.0 - scale
        };
        let (mut bounded, mut unbounded) = (0, 0);
        for _ in 0..2000 {
            let mut interval = || {
                let (a, b) = (number(), number());
                Interval::new(a.min(b), a.max(b)).unwrap()
            };
            let (x, y) = (interval(), interval());
            let ends = |x: Interval| [x.low(), x.high()].map(end);
            for operation in Operation::ALL {
                let result = operation.apply(&x, &y);
                if result == Interval::ALL {
                    unbounded += 1;
                    assert!(operation == Operation::Div && y.contains(0.0));
                    continue;
                }
                bounded += 1;
                for a in ends(x) {
                    for b in ends(y) {
                        let exact = match operation {
                            Operation::Add => &a + &b,
                            Operation::Sub => &a - &b,
                            Operation::Mul | Operation::Fused => &a * &b,
                            Operation::Div => &a / &b,
                        };
                        assert!(end(result.low()) <= exact && exact <= end(result.high()));
                    }
                }
            }
        }
        assert!(bounded > 6000 && unbounded > 100, "{bounded} {unbounded}");
    }
}
