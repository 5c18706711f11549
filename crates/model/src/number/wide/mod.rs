//! A float of 256 bits: what errors of emitted code are measured against.
//!
//! A value is ±m·2^e with an integer m of 256 bits, the highest of which is one; every operation
//! cuts its result to that many, so its relative error is below 2⁻²⁵⁵. There is no infinity, no NaN
//! and, for any exponent of a robot, no overflow. Numbers come from integers, as constants do.
//!
//! - `limbs`: significands

mod limbs;

use core::cmp::Ordering;

use num_bigint::BigInt;
use num_traits::float::FloatCore;
use num_traits::{One, Signed};

use super::trig::sin_cos;
use super::{Angle, Exact, Rational, Rounded};
use crate::scalar::{Divide, Scalar, SinCosPair};
use limbs::{LIMBS, Limbs};

const BITS: u64 = 256;

/// A number of 256 bits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Wide {
    negative: bool,
    /// All zero if the value is; its exponent is zero then, and it is not negative.
    significand: Limbs,
    exponent: i64,
}

impl Wide {
    /// Returns a double, exactly; `None` if it is not finite.
    pub fn from_f64(value: f64) -> Option<Wide> {
        let (mantissa, exponent, sign) = FloatCore::integer_decode(value);
        let bits = u32::from(mantissa > 0) * (u64::BITS - mantissa.leading_zeros());
        if !value.is_finite() || bits == 0 {
            return value.is_finite().then(Wide::zero);
        }
        let mut significand = [0; LIMBS];
        significand[LIMBS - 1] = mantissa << (u64::BITS - bits);
        Some(Wide {
            negative: sign < 0,
            significand,
            exponent: i64::from(exponent) + i64::from(bits) - BITS as i64,
        })
    }

    /// Returns a rational, cut to 256 bits.
    pub fn from_rational(value: &Rational) -> Wide {
        let (numerator, denominator) = (value.numer(), value.denom());
        let missing = BITS + denominator.bits() + 1;
        let shift = missing.saturating_sub(numerator.bits());
        Wide::cut(&((numerator << shift) / denominator), -(shift as i64))
    }

    /// Returns an exact constant.
    pub fn from_exact(constant: &Exact) -> Wide {
        let rational = &mut |value: &Rational| Some(Wide::from_rational(value));
        let value = constant.map(rational, &mut Wide::sincos);
        value.unwrap_or_else(Wide::zero)
    }

    /// Returns sine and cosine of an angle, each within 2⁻²⁵⁵ of the true value.
    pub fn sincos(angle: &Angle) -> SinCosPair<Wide> {
        Wide::sincos_to(angle, BITS as usize + 16)
    }

    /// Returns sine and cosine of radians, also of the smallest double; `None` if it is not finite.
    pub fn sincos_of(radians: f64) -> Option<SinCosPair<Wide>> {
        let angle = Angle::Radians(Rational::from_float(radians)?);
        // So many of the sine's first bits may be zero.
        let (_, exponent, _) = FloatCore::integer_decode(radians);
        let more = usize::from(exponent.min(0).unsigned_abs());
        Some(Wide::sincos_to(&angle, BITS as usize + 16 + more))
    }

    fn sincos_to(angle: &Angle, bits: usize) -> SinCosPair<Wide> {
        let (sin, cos) = sin_cos(angle, bits);
        SinCosPair {
            sin: Wide::cut(&sin, -(bits as i64)),
            cos: Wide::cut(&cos, -(bits as i64)),
        }
    }

    /// Returns the nearest double.
    pub fn to_f64(&self) -> f64 {
        f64::nearest_rational(&self.to_rational())
    }

    /// Returns its value, exactly.
    pub fn to_rational(&self) -> Rational {
        let power = self.exponent.unsigned_abs();
        let whole = self.whole();
        match self.exponent < 0 {
            true => Rational::new(whole, BigInt::one() << power),
            false => Rational::from_integer(whole << power),
        }
    }

    /// Returns the square root, zero of what is negative.
    #[must_use]
    pub fn sqrt(&self) -> Wide {
        let whole = self.whole();
        if !whole.is_positive() {
            return Wide::zero();
        }
        // Twice the bits, and an even exponent.
        let missing = BITS as i64 + 2;
        let shift = missing + (self.exponent - missing).rem_euclid(2);
        Wide::cut(&(whole << shift).sqrt(), (self.exponent - shift) / 2)
    }

    /// Returns self / other; `None` if that is zero.
    pub fn over(&self, other: &Wide) -> Option<Wide> {
        if other.is_zero() {
            return None;
        }
        // The quotient has the bits of a significand and one more.
        let shift = BITS + 1;
        let exponent = self.exponent.saturating_sub(other.exponent);
        let quotient = (self.whole() << shift) / other.whole();
        Some(Wide::cut(&quotient, exponent.saturating_sub(shift as i64)))
    }

    /// True if it is below zero.
    pub fn is_negative(&self) -> bool {
        self.negative
    }

    /// Returns |self|, rounded up to a double.
    pub fn magnitude(&self) -> f64 {
        const DROPPED: u32 = u64::BITS - f64::MANTISSA_DIGITS;
        let [least, less, more, first] = self.significand;
        let below = least | less | more | (first << f64::MANTISSA_DIGITS);
        let top = (first >> DROPPED) + u64::from(below != 0);
        let dropped = BITS as i64 - i64::from(f64::MANTISSA_DIGITS);
        let exponent = self.exponent.saturating_add(dropped).clamp(-4000, 4000) as i32;
        // At most 2⁵³: a double.
        let top = top as f64;
        if exponent.unsigned_abs() < 960 {
            // A power of two, and a product that is normal: nothing is rounded.
            return top * f64::from_bits((1023 + i64::from(exponent)).unsigned_abs() << 52);
        }
        let value = libm::ldexp(top, exponent);
        // A value below the least normal double has been rounded on the way.
        let is_subnormal = value < f64::MIN_POSITIVE && !self.is_zero();
        if is_subnormal { value.next_up() } else { value }
    }

    fn whole(&self) -> BigInt {
        limbs::whole(&self.significand, self.negative)
    }

    fn cut(whole: &BigInt, exponent: i64) -> Wide {
        limbs::cut(whole).map_or_else(Wide::zero, |(significand, power)| Wide {
            negative: whole.is_negative(),
            significand,
            exponent: exponent.saturating_add(power),
        })
    }
}

impl Scalar for Wide {
    fn zero() -> Self {
        Wide::default()
    }
    fn one() -> Self {
        let mut significand = [0; LIMBS];
        significand[LIMBS - 1] = 1 << (u64::BITS - 1);
        Wide {
            negative: false,
            significand,
            exponent: 1 - BITS as i64,
        }
    }
    fn add(&self, other: &Self) -> Self {
        if self.is_zero() || other.is_zero() {
            return if self.is_zero() { *other } else { *self };
        }
        let (high, low) = match self.exponent >= other.exponent {
            true => (self, other),
            false => (other, self),
        };
        let gap = match u32::try_from(high.exponent.abs_diff(low.exponent)) {
            Ok(gap) if u64::from(gap) <= BITS => gap,
            // The other is less than the last bit.
            _ => return *high,
        };
        if high.negative == low.negative {
            let (significand, more) = limbs::sum(&high.significand, &low.significand, gap);
            return Wide {
                significand,
                exponent: high.exponent.saturating_add(i64::from(more)),
                ..*high
            };
        }
        let (significand, shift, order) =
            limbs::difference(&high.significand, &low.significand, gap);
        match order {
            Ordering::Equal => Wide::zero(),
            order => Wide {
                negative: high.negative != (order == Ordering::Less),
                significand,
                exponent: high.exponent.saturating_sub(i64::from(shift)),
            },
        }
    }
    fn mul(&self, other: &Self) -> Self {
        if self.is_zero() || other.is_zero() {
            return Wide::zero();
        }
        let (significand, less) = limbs::product(&self.significand, &other.significand);
        let exponent = self.exponent.saturating_add(other.exponent);
        Wide {
            negative: self.negative != other.negative,
            significand,
            exponent: exponent.saturating_add(BITS as i64 - i64::from(less)),
        }
    }
    fn neg(&self) -> Self {
        let negative = !self.negative && !self.is_zero();
        Wide { negative, ..*self }
    }
    fn half(&self) -> Self {
        // The exponent of zero stays zero.
        let exponent = self.exponent.saturating_sub(i64::from(!self.is_zero()));
        Wide { exponent, ..*self }
    }
    fn is_zero(&self) -> bool {
        // The highest bit of a nonzero value is one.
        self.significand[LIMBS - 1] == 0
    }
}

impl Divide for Wide {
    /// Divides; by zero: zero, for want of an infinity.
    fn div(&self, other: &Self) -> Self {
        self.over(other).unwrap_or_else(Self::zero)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::parse::parse_decimal;
    use crate::scalar::field::Points;

    fn ratio(n: i64, d: i64) -> Wide {
        Wide::from_rational(&Rational::new(n.into(), d.into()))
    }

    #[test]
    fn it_is_exact_to_76_digits() {
        let third = ratio(1, 3);
        let one = third.add(&third).add(&third);
        let off = one.sub(&Wide::one()).magnitude();
        assert!(off < 1e-76, "{off:e}");
        let root = ratio(2, 1).sqrt();
        let off = root.mul(&root).sub(&ratio(2, 1)).magnitude();
        assert!(off < 1e-75, "{off:e}");
        assert_eq!(ratio(-2, 1).sqrt(), Wide::zero());
        assert_eq!(ratio(-1, 3).to_f64(), -1.0 / 3.0);
        assert_eq!(Wide::from_f64(5e-324).unwrap().to_f64(), 5e-324);
    }

    #[test]
    fn sines_are_exact_to_76_digits() {
        // By another library; the cosine of the double nearest to π/2 is 6e-17, where its own
        // digits count, and the sine of 1e22 is the classical test of the reduction.
        let float = |x| Angle::Radians(Rational::from_float(x).unwrap());
        let cases = [
            (
                float(1e22),
                "-0.8522008497671888017727058937530293682617621504100436562565093260259103",
                "0.5232147853951389454975944733847094921409199724393879535272113921042982",
            ),
            (
                float(1e8),
                "0.9316390271097260080275166536120429704729018385275364343082838951377085",
                "-0.3633850893556905538723753525471001109242591608743450338614273001604573",
            ),
            (
                float(core::f64::consts::FRAC_PI_2),
                "0.9999999999999999999999999999999981253002716726780066919054431429030069",
                "0.000000000000000061232339957367658861303296613750014646403777988362830520960549827724863083",
            ),
            (
                Angle::Radians(Rational::new(100_000_001.into(), 3.into())),
                "-0.8972480653247857786621955002224547409844971199531700126290374231224449",
                "0.4415267933783055843488219302431761577399738907081202532594240236267627",
            ),
            (
                Angle::PiTimes(Rational::new(1.into(), 7.into())),
                "0.4338837391175581204757683328483587546099907277874598764445473035322032",
                "0.9009688679024191262361023195074450511659191621318571500535624231994324",
            ),
        ];
        for (angle, sin, cos) in cases {
            let pair = Wide::sincos(&angle);
            for (found, digits) in [(pair.sin, sin), (pair.cos, cos)] {
                let expected = Wide::from_rational(&parse_decimal(digits).unwrap());
                let off = found.sub(&expected).magnitude();
                assert!(off < 1e-69, "{digits}: {off:e}");
            }
        }
        assert_eq!(Wide::sincos_of(5e-324).unwrap().sin.to_f64(), 5e-324);
    }

    #[test]
    fn magnitudes_are_rounded_up() {
        assert_eq!(ratio(3, 4).neg().magnitude(), 0.75);
        assert!(ratio(1, 3).magnitude() > 1.0 / 3.0);
        assert_eq!(ratio(1, 3).magnitude(), (1.0f64 / 3.0).next_up());
        assert_eq!(Wide::zero().magnitude(), 0.0);
        let tiny = Wide::from_f64(5e-324).unwrap();
        assert!(tiny.magnitude() >= 5e-324 && tiny.mul(&tiny).magnitude() > 0.0);
        let huge = Wide::from_f64(f64::MAX).unwrap();
        assert_eq!(huge.mul(&huge).magnitude(), f64::INFINITY);
        assert_eq!(Wide::from_f64(f64::NAN), None);
    }

    /// Numbers near each other and far apart, with few bits and with many, are within 2⁻²⁵⁵.
    #[test]
    fn operations_are_those_of_rationals() {
        let mut points = Points::new(1);
        let mut draw = || points.bits() >> 33;
        let least = Rational::new(BigInt::one(), BigInt::one() << 255u32);
        let mut number = || {
            let mut whole = BigInt::from(draw() % 5) - BigInt::from(2);
            for _ in 0..draw() % 12 {
                let run = [0, u32::MAX, draw() as u32][(draw() % 3) as usize];
                whole = (whole << 32u32) + BigInt::from(run);
            }
            let shift = [0, draw() % 4, draw() % 600][(draw() % 3) as usize];
            Wide::cut(&whole, 0).mul(&Wide::cut(&BigInt::one(), -(shift as i64)))
        };
        for _ in 0..20_000 {
            let (a, b) = (number(), number());
            let (x, y) = (a.to_rational(), b.to_rational());
            let quotient = if b.is_zero() { y.clone() } else { &x / &y };
            let cases = [
                (a.add(&b), &x + &y),
                (a.sub(&b), &x - &y),
                (a.sub(&a), &x - &x),
                (a.half(), &x / Rational::from_integer(2.into())),
                (a.sub(&a.add(&b)), &x - a.add(&b).to_rational()),
                (a.mul(&b), &x * &y),
                (a.div(&b), quotient),
            ];
            for (result, exact) in cases {
                let off = (result.to_rational() - &exact).abs();
                assert!(off <= exact.abs() * &least, "{a:?} {b:?}");
                assert_eq!(result, Wide::from_rational(&result.to_rational()));
            }
            let size = a.magnitude();
            let exact = Rational::from_float(size).unwrap();
            assert!(exact >= x.abs() && (size == 0.0) == a.is_zero());
            assert_eq!(Wide::from_f64(size).unwrap().to_rational(), exact);
        }
    }
}
