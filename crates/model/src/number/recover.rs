//! The numbers that were meant, from what a computation in wide floats made of them.
//!
//! Geometry needs roots and arcs, which exact constants have not. But where the result of a
//! computation with 256 bits is within 2⁻²⁰⁰ of a simple fraction, or of a simple multiple of π, it
//! *is* that number, or so close that no given digit can tell: an arm whose angles are multiples of
//! π/2 and whose lengths are decimals keeps its decimals. All else is rounded once, to 20 digits.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, Zero};

use super::{Angle, Rational, Rounded, SnappedAngle, Wide, ratio};
use crate::scalar::Scalar;

/// The most bits of the denominator of a fraction that was meant.
const SIMPLE: u64 = 90;
/// The digits that everything else is rounded to.
const DIGITS: i64 = 20;

/// Returns 2⁻²⁰⁰: a result closer to a number than this, times its inputs' size, is that number.
pub fn near() -> Rational {
    Rational::new(BigInt::one(), BigInt::one() << 200u32)
}

/// Returns the fraction that a number from others of this size was meant to be, else 20 digits.
pub fn recovered(value: &Wide, size: &Rational) -> Rational {
    let value = value.to_rational();
    simple(&value, &(size * near())).unwrap_or_else(|| rounded(&value))
}

/// Returns the simplest fraction within 2 to the power of minus so many bits: mostly of half of them.
pub fn short(value: &Rational, bits: u32) -> Rational {
    let near = Rational::new(BigInt::one(), BigInt::one() << bits);
    let size = value.abs();
    if size <= near {
        return Rational::zero();
    }
    let least = simplest(&size - &near, size + near);
    if value.is_negative() { -least } else { least }
}

/// Returns the simplest fraction between two that are positive: the convergents of all numbers
/// between them begin alike, up to one that differs.
fn simplest(low: Rational, high: Rational) -> Rational {
    let whole = low.ceil();
    if whole <= high {
        return whole;
    }
    let whole = low.floor();
    let rest = simplest((high - &whole).recip(), (low - &whole).recip());
    whole + rest.recip()
}

impl Angle {
    /// Returns the angle whose sine and cosine are in this ratio, in (−π, π]: a multiple of π or a
    /// number of radians that was meant, or radians rounded to 20 digits. Zero for two zeros.
    pub fn recovered(sin: &Wide, cos: &Wide) -> Angle {
        let radians = arc(sin, cos);
        let pi = Angle::PiTimes(Rational::one()).radians();
        if let Some(multiple) = simple(&(&radians / &pi), &near()) {
            return Angle::PiTimes(multiple);
        }
        let meant = simple(&radians, &near()).unwrap_or_else(|| rounded(&radians));
        match SnappedAngle::of_radians(meant.clone()) {
            // Radians so near a right angle are read as that; multiples of π as written.
            SnappedAngle::Taken(_) => Angle::PiTimes(rounded(&(radians / pi))),
            _ => Angle::Radians(meant).canonical(),
        }
    }
}

/// Takes the first convergent of the continued fraction that is this near, if it is simple.
fn simple(value: &Rational, near: &Rational) -> Option<Rational> {
    // Euclid's algorithm on integers: fractions would be cancelled at every step.
    let (numer, denom) = (value.numer(), value.denom());
    let (mut rest, mut divisor) = (numer.clone(), denom.clone());
    let mut before = [BigInt::zero(), BigInt::one()];
    let mut last = [BigInt::one(), BigInt::zero()];
    while !divisor.is_zero() {
        let (whole, remainder) = rest.div_mod_floor(&divisor);
        let next = [0, 1].map(|i| &whole * &last[i] + &before[i]);
        let [p, q] = &next;
        if q.bits() > SIMPLE {
            return None;
        }
        let off = (p * denom - numer * q).abs();
        if off * near.denom() <= near.numer() * q * denom {
            return Some(Rational::new(p.clone(), q.clone()));
        }
        (rest, divisor) = (divisor, remainder);
        (before, last) = (last, next);
    }
    None
}

/// Rounds to 20 digits, or 21: half away from zero.
pub fn rounded(value: &Rational) -> Rational {
    if value.is_zero() {
        return Rational::zero();
    }
    // 2^bits is within a factor of two of the size; 30103/100000 is log₁₀ 2.
    let bits = value.numer().bits() as i64 - value.denom().bits() as i64;
    let digits = DIGITS - Integer::div_floor(&(bits * 30103), &100_000);
    let power = Rational::from_integer(10.into()).pow(digits as i32);
    (value * &power).round() / power
}

/// Returns the angle of the point (cos, sin), in (−π, π], to 2⁻²⁴⁰ or so.
fn arc(sin: &Wide, cos: &Wide) -> Rational {
    let size = sin.mul(sin).add(&cos.mul(cos)).sqrt();
    let (Some(sin), Some(cos)) = (sin.over(&size), cos.over(&size)) else {
        return Rational::zero();
    };
    // A sine that is negligible beside the cosine has no sign: −π is π.
    let is_level = sin.to_rational().abs() <= near();
    let sin = if is_level { Wide::zero() } else { sin };
    let [y, x] = [&sin, &cos].map(|part| f64::nearest_rational(&part.to_rational()));
    let start = Rational::from_float(libm::atan2(y, x)).unwrap_or_else(Rational::zero);
    let at = Wide::sincos(&Angle::Radians(start.clone()));
    // The sine of what is missing, 1e-16 or less: arcsin x = x + x³/6 + 3x⁵/40 …
    let x = sin.mul(&at.cos).sub(&cos.mul(&at.sin)).to_rational();
    let square = &x * &x;
    let series = ratio(1, 1) + &square * (ratio(1, 6) + &square * ratio(3, 40));
    start + x * series
}

#[cfg(test)]
mod tests {
    use alloc::string::ToString;

    use num_traits::ToPrimitive;

    use super::*;

    fn comes_back(angle: Angle) {
        let pair = Wide::sincos(&angle);
        let size = Wide::from_rational(&ratio(7, 3));
        let found = Angle::recovered(&pair.sin.mul(&size), &pair.cos.mul(&size));
        assert_eq!(found, angle);
    }

    /// Checks that a number is this many times 10⁻²⁰, within one of them.
    fn is_near(radians: &Rational, digits: i128) {
        let unit = Rational::new(1.into(), BigInt::from(10).pow(20));
        let off = radians - Rational::from_integer(digits.into()) * &unit;
        assert!(off.abs() <= unit, "{radians}");
    }

    #[test]
    fn angles_beside_right_angles_read_as_they_are() {
        let less = Angle::Radians(Rational::new(61.into(), BigInt::from(10).pow(18)));
        let pair = Wide::sincos(&less);
        let angle = Angle::recovered(&pair.cos, &pair.sin);
        let read = Angle::parse(&angle.to_string()).unwrap();
        assert_eq!(read, angle);
        assert_eq!(angle.quarter_turns(), None);
        let sum = angle.radians() + less.radians();
        let off = (sum - Angle::right_angles(1).radians()).to_f64().unwrap();
        assert!(off.abs() < 1e-19, "{angle}: {off:e}");
    }

    #[test]
    fn angles_come_back() {
        for n in -11..=12 {
            comes_back(Angle::PiTimes(ratio(n, 12)));
        }
        comes_back(Angle::PiTimes(ratio(-17_345, 180_000)));
        for (n, d) in [(3, 10), (-31_415, 10_000), (1, 3), (1, 1 << 40)] {
            comes_back(Angle::Radians(ratio(n, d)));
        }
        let zero = Wide::zero();
        assert_eq!(Angle::recovered(&zero, &zero), Angle::default());
        let tiny = Wide::from_rational(&Rational::new(1.into(), BigInt::one() << 240));
        let back = Wide::one().neg();
        let half_turn = Angle::right_angles(2);
        assert_eq!(Angle::recovered(&tiny, &back), half_turn);
        assert_eq!(Angle::recovered(&tiny.neg(), &back), half_turn);
    }

    /// atan2(1, 2) = 0.46364760900080611621425623146121…
    #[test]
    fn other_angles_are_rounded_once() {
        let [one, two] = [ratio(1, 1), ratio(2, 1)].map(|x| Wide::from_rational(&x));
        let Angle::Radians(radians) = Angle::recovered(&one, &two) else {
            panic!("a number of radians");
        };
        is_near(&radians, 46_364_760_900_080_611_621);
    }

    #[test]
    fn decimals_come_back_and_noise_goes() {
        let size = ratio(1, 1);
        let third = Wide::from_rational(&ratio(1, 3));
        let noise = third.add(&third).add(&third).sub(&Wide::one());
        for (n, d) in [(4318, 10_000), (-1, 12), (123_456_789_012_345_678, 1 << 40)] {
            let noisy = Wide::from_rational(&ratio(n, d)).add(&noise);
            assert_eq!(recovered(&noisy, &size), ratio(n, d));
        }
        assert_eq!(recovered(&noise, &size), Rational::zero());
        let root = Wide::from_rational(&ratio(2, 1)).sqrt();
        // √2 = 1.41421356237309504880168872…
        is_near(&recovered(&root, &size), 141_421_356_237_309_504_880);
        assert_eq!(rounded(&ratio(1, 1_000_000)), ratio(1, 1_000_000));
        assert_eq!(rounded(&ratio(25_000_000, 1)), ratio(25_000_000, 1));
    }
}
