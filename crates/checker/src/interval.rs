//! Intervals of doubles, rounded outward, and sines of them.

use std::ops::{Add, Mul, Neg};

/// Half an ulp of a double of size one: what rounding to nearest costs at most,
/// relative to the result.
pub const UNIT: f64 = f64::EPSILON / 2.0;

/// All numbers from `low` to `high`; an infinite end where nothing is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// The lower end.
    pub low: f64,
    /// The upper end.
    pub high: f64,
}

impl Interval {
    /// All numbers: nothing is known.
    pub const NOTHING_KNOWN: Interval = Interval {
        low: f64::NEG_INFINITY,
        high: f64::INFINITY,
    };

    /// Returns the numbers between two ends; everything if these are no numbers in order.
    pub const fn new(low: f64, high: f64) -> Interval {
        match low <= high {
            true => Interval { low, high },
            false => Interval::NOTHING_KNOWN,
        }
    }

    /// Returns one number.
    pub fn point(value: f64) -> Interval {
        Interval::new(value, value)
    }

    /// Returns all numbers at most so far from a number.
    pub fn around(value: f64, radius: f64) -> Interval {
        Interval::new((value - radius).next_down(), (value + radius).next_up())
    }

    pub(crate) fn ends(self) -> [f64; 2] {
        [self.low, self.high]
    }

    /// Returns the largest magnitude in it.
    pub fn magnitude(self) -> f64 {
        self.low.abs().max(self.high.abs())
    }

    pub(crate) fn least(self) -> f64 {
        match self.low <= 0.0 && self.high >= 0.0 {
            true => 0.0,
            false => self.low.abs().min(self.high.abs()),
        }
    }

    pub(crate) fn sine(self, is_sine: bool) -> Interval {
        if self.low == self.high && self.magnitude() < FARTHEST {
            let (sin, cos) = sin_cos(self.low);
            return Interval::around(if is_sine { sin } else { cos }, SINE_ERROR);
        }
        Interval::new(-1.0, 1.0)
    }

    /// Returns the numbers of it that are at most so far from zero: all are known to be.
    pub(crate) fn within(self, most: f64) -> Interval {
        Interval::new(self.low.max(-most), self.high.min(most))
    }

    /// Returns one step outward: an operation on the ends was rounded to nearest.
    pub(crate) fn outward(low: f64, high: f64) -> Interval {
        Interval::new(low.next_down(), high.next_up())
    }
}

/// Rounds up; zero is exact.
pub(crate) fn up(x: f64) -> f64 {
    if x == 0.0 { x } else { x.next_up() }
}

/// Zero, exactly: what it is added to, and finite numbers times it, need no rounding.
const ZERO: Interval = Interval::new(0.0, 0.0);

impl Add for Interval {
    type Output = Interval;
    fn add(self, other: Interval) -> Interval {
        if self == ZERO {
            return other;
        }
        if other == ZERO {
            return self;
        }
        Interval::outward(self.low + other.low, self.high + other.high)
    }
}

impl Neg for Interval {
    type Output = Interval;
    fn neg(self) -> Interval {
        Interval::new(-self.high, -self.low)
    }
}

impl Mul for Interval {
    type Output = Interval;
    fn mul(self, other: Interval) -> Interval {
        if (self == ZERO || other == ZERO) && (self.magnitude() + other.magnitude()).is_finite() {
            return ZERO;
        }
        let (a, b) = (self.low * other.low, self.low * other.high);
        let (c, d) = (self.high * other.low, self.high * other.high);
        if [a, b, c, d].iter().any(|x| x.is_nan()) {
            return Interval::NOTHING_KNOWN;
        }
        Interval::outward(a.min(b).min(c.min(d)), a.max(b).max(c.max(d)))
    }
}

/// The errors of what [`sin_cos`] returns are below this, for angles up to [`FARTHEST`].
pub const SINE_ERROR: f64 = 1e-15;
/// The largest angle of which sines are known here, rad.
pub const FARTHEST: f64 = 1000.0;

/// Returns sine and cosine of a double by Taylor's series, each within [`SINE_ERROR`] for
/// |x| ≤ 1000.
///
/// π/2 is taken off as the sum of two doubles and a third: the first has 33 bits, so
/// that its multiples are exact, and what is left out of π/2 is below 1e-26. The
/// rest of x, at most 0.79, is off by less than 3e-16; the series, cut behind r¹⁹,
/// is off by less than 1e-20 and rounded by less than 3e-16.
pub fn sin_cos(x: f64) -> (f64, f64) {
    const FIRST: f64 = 1.570_796_326_734_125_6;
    const SECOND: f64 = 6.077_100_506_303_966e-11;
    const THIRD: f64 = 2.022_266_248_795_950_7e-21;
    let quarters = (x / std::f64::consts::FRAC_PI_2).round();
    let r = ((x - quarters * FIRST) - quarters * SECOND) - quarters * THIRD;
    let square = r * r;
    let (mut sin, mut cos) = (0.0, 0.0);
    // Horner: 1 − r²/(n(n + 1))·(1 − …), from the smallest term on.
    for n in (1..=9).rev() {
        let n = f64::from(2 * n);
        sin = (1.0 - sin) * square / (n * (n + 1.0));
        cos = (1.0 - cos) * square / (n * (n - 1.0));
    }
    let (sin, cos) = (r - r * sin, 1.0 - cos);
    match quarters.rem_euclid(4.0) as u8 {
        0 => (sin, cos),
        1 => (cos, -sin),
        2 => (-sin, -cos),
        _ => (-cos, sin),
    }
}
