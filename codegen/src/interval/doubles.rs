//! Intervals of doubles, rounded outward.
//!
//! **Soundness.** IEEE arithmetic rounds to nearest: the exact result of one operation lies between
//! the doubles next to the computed one on either side. Every operation here computes its ends to
//! nearest and then moves each outward by one double, so the interval contains the exact result of
//! every choice of operands in the operands' intervals. An end that overflows becomes infinite; a
//! NaN (∞ − ∞ or 0 · ∞) becomes the whole line, which says nothing and is therefore true.

use dalembert_model::number::{Exact, Rational, Rounded};

/// All numbers from `low` to `high`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    low: f64,
    high: f64,
}

impl Interval {
    /// Zero, exactly.
    pub const ZERO: Interval = Interval::point(0.0);
    /// One, exactly.
    pub const ONE: Interval = Interval::point(1.0);
    /// Every number.
    pub const ALL: Interval = Interval {
        low: f64::NEG_INFINITY,
        high: f64::INFINITY,
    };

    /// Returns one number, exactly.
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

    /// Returns an enclosure of an exact constant: the neighbours of the nearest double.
    pub fn exact(value: &Exact) -> Interval {
        if let Some(rational) = value.as_rational() {
            return Interval::rational(rational);
        }
        let near = f64::nearest(value);
        checked(near.next_down(), near.next_up())
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

    /// Returns the lower end.
    pub fn low(self) -> f64 {
        self.low
    }

    /// Returns the upper end.
    pub fn high(self) -> f64 {
        self.high
    }

    /// Returns the largest |x|.
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

    /// Returns the width, roughly.
    pub fn width(self) -> f64 {
        self.high - self.low
    }

    /// Returns whether a number lies inside.
    pub fn contains(self, x: f64) -> bool {
        self.low <= x && x <= self.high
    }

    /// Returns the least interval around both.
    pub fn hull(self, other: Interval) -> Interval {
        Interval {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
        }
    }

    /// Returns both halves.
    pub fn split(self) -> [Interval; 2] {
        let mid = self.mid();
        [checked(self.low, mid), checked(mid, self.high)]
    }

    /// Returns x²
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
pub(super) fn around([a, b, c, d]: [f64; 4]) -> Interval {
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

#[cfg(test)]
mod tests {
    use super::*;

    fn ratio(n: i64, d: i64) -> Rational {
        Rational::new(n.into(), d.into())
    }

    #[test]
    fn rationals_and_squares_are_contained() {
        let end = |x: f64| Rational::from_float(x).unwrap();
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
}
