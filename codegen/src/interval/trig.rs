//! Sine and cosine of an interval.
//!
//! **Assumption** (named in certificates): the `libm` crate's `sin` and `cos` of a double are
//! within one ulp of the true value (`tests/libm_ulps.rs` measures it). Here two are allowed, one
//! of them for a value next to a power of two, where an ulp changes.
//!
//! **Soundness.** Between its stationary points a sine is monotonic, so over
//! an interval it lies between its values at the ends, and ±1 where the
//! interval holds a stationary point. Which of them it may hold is decided
//! with an enclosure of 1/π, so one is at worst counted where there is none.

use crate::interval::Interval;

/// 1/π lies between this double and the next.
const INVERSE_PI: f64 = std::f64::consts::FRAC_1_PI;

/// Beyond this, an interval says nothing about its quadrant.
const LARGEST: f64 = 1e9;

impl Interval {
    /// Returns the sines of its numbers.
    pub fn sin(self) -> Interval {
        periodic(self, libm::sin, Interval::point(0.5))
    }

    /// Returns the cosines of its numbers.
    pub fn cos(self) -> Interval {
        periodic(self, libm::cos, Interval::ZERO)
    }
}

/// Returns a function with value (−1)^k at its stationary points (k + shift)·π.
fn periodic(x: Interval, function: fn(f64) -> f64, shift: Interval) -> Interval {
    let unit = Interval::symmetric(1.0);
    if x.magnitude().is_nan() || x.magnitude() > LARGEST {
        return unit;
    }
    let at = |end: f64| {
        let y = function(end);
        let two = |y: f64, step: fn(f64) -> f64| step(step(y)).clamp(-1.0, 1.0);
        (two(y, f64::next_down), two(y, f64::next_up))
    };
    let ((a, b), (c, d)) = (at(x.low()), at(x.high()));
    let (mut low, mut high) = (a.min(c), b.max(d));
    let pi = Interval::new(INVERSE_PI.next_down(), INVERSE_PI.next_up()).unwrap_or(Interval::ALL);
    let turns = x * pi - shift;
    let (first, last) = (libm::ceil(turns.low()), libm::floor(turns.high()));
    if last - first >= 1.0 {
        return unit;
    }
    if first == last {
        if libm::fmod(first, 2.0) == 0.0 {
            high = 1.0;
        } else {
            low = -1.0;
        }
    }
    Interval::new(low, high).unwrap_or(unit)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    #[test]
    fn contains_every_sample_and_is_not_wide() {
        let mut random = Random::new(3);
        for _ in 0..3000 {
            let low = 20.0 * (random.unit() - 0.5);
            let width = 7.0 * random.unit() * random.unit();
            let x = Interval::new(low, low + width).unwrap();
            let (sin, cos) = (x.sin(), x.cos());
            let (mut seen_sin, mut seen_cos) =
                (Interval::point(sin.mid()), Interval::point(cos.mid()));
            for k in 0..=400 {
                let t = (low + width * f64::from(k) / 400.0).clamp(x.low(), x.high());
                let (s, c) = libm::sincos(t);
                assert!(sin.contains(s) && cos.contains(c), "{x:?} {t}");
                seen_sin = seen_sin.hull(Interval::point(s));
                seen_cos = seen_cos.hull(Interval::point(c));
            }
            assert!(sin.width() <= seen_sin.width() + 4e-4, "{x:?}");
            assert!(cos.width() <= seen_cos.width() + 4e-4, "{x:?}");
        }
    }

    #[test]
    fn right_angles_and_full_turns() {
        let pi = std::f64::consts::PI;
        let turn = Interval::symmetric(pi);
        assert_eq!(
            (turn.sin(), turn.cos()),
            (Interval::symmetric(1.0), Interval::symmetric(1.0))
        );
        let quarter = Interval::new(0.0, pi / 2.0).unwrap();
        assert!(quarter.sin().low() >= -1e-300 && quarter.sin().high() == 1.0);
        assert!(quarter.cos().contains(1.0) && quarter.cos().low() < 6.2e-17);
        assert_eq!(Interval::point(1e300).sin(), Interval::symmetric(1.0));
    }
}
