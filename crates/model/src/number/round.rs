//! Correct rounding of exact constants: once, to nearest, ties to even.

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, ToPrimitive, Zero};

use super::exact::{Canonical, Terms};
use super::rationals::nearest_double;
use super::trig::{SLACK, sin_cos};
use super::{Exact, Rational};
use alloc::collections::BTreeMap;

/// A floating-point format that exact constants round to.
pub trait Rounded: Copy + PartialEq {
    /// Significand bits, the hidden one included.
    const DIGITS: i64;
    /// Exponent of the least subnormal: it is 2^`LEAST`.
    const LEAST: i64;
    /// Exponent e of the largest finite number: it is below 2^e.
    const MAX: i64;
    /// Makes it from a double that the format holds exactly, or an infinity.
    fn from_exact_f64(value: f64) -> Self;
    /// Returns the nearest value of an exact constant; an infinity beyond the range.
    fn nearest(value: &Exact) -> Self {
        match &value.0 {
            Canonical::Rational(value) => Self::nearest_rational(value),
            Canonical::Polynomial(terms) => round_polynomial(terms),
        }
    }
    /// Returns the nearest value of a rational; an infinity beyond the range.
    fn nearest_rational(value: &Rational) -> Self {
        if Self::DIGITS == i64::from(f64::MANTISSA_DIGITS)
            && let Some(value) = nearest_double(value)
        {
            return Self::from_exact_f64(value);
        }
        let magnitude = round_magnitude(value, Self::DIGITS, Self::LEAST, Self::MAX);
        let sign = if value.is_negative() { -1.0 } else { 1.0 };
        Self::from_exact_f64(sign * magnitude)
    }
}

impl Rounded for f64 {
    const DIGITS: i64 = 53;
    const LEAST: i64 = -1074;
    const MAX: i64 = 1024;
    fn from_exact_f64(value: f64) -> Self {
        value
    }
}

impl Rounded for f32 {
    const DIGITS: i64 = 24;
    const LEAST: i64 = -149;
    const MAX: i64 = 128;
    fn from_exact_f64(value: f64) -> Self {
        value as f32
    }
}

/// |value| rounded to a format, as a double that holds it exactly.
pub(super) fn round_magnitude(value: &Rational, digits: i64, least: i64, most: i64) -> f64 {
    if value.is_zero() {
        return 0.0;
    }
    let (n, d) = (value.numer().abs(), value.denom());
    // 2^(top−1) < |value| < 2^(top+1): the last bit kept is 2^unit.
    let top = n.bits() as i64 - d.bits() as i64;
    let mut unit = (top - digits).max(least);
    let mut quotient = divide(&n, d, unit);
    if quotient.0.bits() as i64 > digits {
        unit += 1;
        quotient = divide(&n, d, unit);
    }
    let (mut significand, rest) = quotient;
    // rest is twice the remainder against the divisor: round half to even.
    if rest.is_gt() || rest.is_eq() && significand.is_odd() {
        significand += 1;
    }
    if significand.bits() as i64 + unit > most {
        return f64::INFINITY;
    }
    // Both factors are exact, and the product is representable.
    libm::ldexp(significand.to_f64().unwrap_or(f64::INFINITY), unit as i32)
}

/// Returns ⌊n/(d·2^unit)⌋ and how twice the remainder compares to the divisor.
fn divide(n: &BigInt, d: &BigInt, unit: i64) -> (BigInt, core::cmp::Ordering) {
    let (n, d) = match unit < 0 {
        true => (n << unit.unsigned_abs(), d.clone()),
        false => (n.clone(), d << unit.unsigned_abs()),
    };
    let (quotient, rest) = n.div_rem(&d);
    (quotient, (rest << 1u32).cmp(&d))
}

/// Rounds a polynomial by Ziv's strategy: more bits until both ends of the enclosure round alike.
fn round_polynomial<T: Rounded>(terms: &Terms) -> T {
    let mut bits = 128;
    loop {
        let (value, error) = enclose(terms, bits);
        // In no lowest terms: rounding divides, and asks for none.
        let near =
            |value: BigInt| T::nearest_rational(&Rational::new_raw(value, BigInt::one() << bits));
        let low = near(&value - &error);
        if low == near(&value + &error) {
            return low;
        }
        if bits > 6000 {
            // Only a relation that the representation does not know, such as sin π/6 = ½, brings a
            // constant this close to a boundary: the value is zero, or the boundary itself.
            let is_zero = value.abs() <= error;
            return near(if is_zero { BigInt::zero() } else { value });
        }
        bits *= 2;
    }
}

/// Returns the value and a bound of its error, both times 2^bits, from sines and cosines
/// to `bits` bits. Fixed point: rationals would be brought to lowest terms, sum by sum.
fn enclose(terms: &Terms, bits: usize) -> (BigInt, BigInt) {
    let mut pairs = BTreeMap::new();
    let (mut value, mut error) = (BigInt::zero(), BigInt::zero());
    for (monomial, coefficient) in terms {
        let mut product = BigInt::one() << bits;
        let mut degree = 0u32;
        for power in monomial {
            let angle = &power.angle;
            let (sin, cos) = pairs.entry(angle).or_insert_with(|| sin_cos(angle, bits));
            let sines = (0..power.sin).map(|_| &*sin);
            for factor in sines.chain((0..power.cos).map(|_| &*cos)) {
                product = (product * factor) >> bits;
                degree += 1;
            }
        }
        value += (coefficient.numer() * product).div_floor(coefficient.denom());
        // Each factor is at most 1 (+ its error), and each product is cut by a unit, fewer
        // than the 2^SLACK of an error: the product rule, doubled. And a unit for the quotient.
        let most = BigInt::from(2 * degree) << SLACK;
        error += (coefficient.numer().abs() * most).div_ceil(coefficient.denom()) + 1;
    }
    (value, error)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::{Angle, ratio};
    use crate::scalar::Scalar;

    #[test]
    fn rationals_round_to_nearest_even() {
        let double = f64::nearest_rational(&ratio(9007199254740993, 1));
        assert_eq!(double, 9007199254740992.0);
        assert_eq!(f32::nearest_rational(&ratio(16777217, 1)), 16777216.0);
        assert_eq!(f32::nearest_rational(&ratio(1, 10)), 0.1f32);
    }

    #[test]
    fn every_double_rounds_to_itself() {
        let times = |x: f64, factor: Rational| {
            f64::nearest_rational(&(Rational::from_float(x).unwrap() * factor))
        };
        let normal = [f64::MAX, f64::MIN_POSITIVE, 1e300];
        let subnormal = [5e-324, 2.225073858507201e-308, -1e-310];
        for x in normal.into_iter().chain(subnormal) {
            assert_eq!(times(x, ratio(1, 1)), x);
        }
        assert_eq!(times(f64::MAX, ratio(3, 2)), f64::INFINITY);
        assert_eq!(times(5e-324, ratio(1, 2)), 0.0);
    }

    #[test]
    fn sines_are_rounded_correctly() {
        let half = Exact::sincos(&Angle::PiTimes(ratio(1, 6))).sin;
        assert_eq!(f64::nearest(&half), 0.5);
        let third = Exact::sincos(&Angle::PiTimes(ratio(1, 3)));
        assert_eq!(f64::nearest(&third.sin), 0.866_025_403_784_438_6);
        assert_eq!(f64::nearest(&third.cos.neg()), -0.5);
        let tenth = Exact::sincos(&Angle::Radians(ratio(3, 10)));
        // sin of 3/10 itself: the sine of the double 0.3 rounds to another double.
        assert_eq!(f64::nearest(&tenth.sin), 0.295_520_206_661_339_6);
        assert_eq!(f32::nearest(&tenth.cos), 0.955_336_5_f32);
    }

    #[test]
    fn a_hidden_zero_rounds_to_zero() {
        let sixth = Exact::sincos(&Angle::PiTimes(ratio(1, 6)));
        let hidden = sixth.sin.sub(&Exact::from(ratio(1, 2)));
        assert!(!hidden.is_zero() && f64::nearest(&hidden) == 0.0);
    }
}
