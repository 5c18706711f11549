//! A float of 256 bits: what errors of emitted code are measured against.
//!
//! A value is m·2^e with an integer m of at most 256 bits; every operation
//! cuts its result to that many, so its relative error is below 2⁻²⁵⁵. There
//! is no infinity, no NaN and, for any exponent that a robot can bring about,
//! no overflow. It needs nothing but the integers that exact constants need.

use num_bigint::BigInt;
use num_traits::{One, Signed, ToPrimitive, Zero};

use super::trig::sin_cos;
use super::{Angle, Exact, Rational};
use crate::scalar::{Divide, Scalar, SinCosPair};

/// The bits of a significand.
const BITS: u64 = 256;

/// A number of 256 bits.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Wide {
    significand: BigInt,
    exponent: i64,
}

impl Wide {
    /// A double, exactly; `None` if it is not finite.
    pub fn from_f64(value: f64) -> Option<Wide> {
        Rational::from_float(value).map(|value| Wide::from_rational(&value))
    }

    /// A rational, cut to 256 bits.
    pub fn from_rational(value: &Rational) -> Wide {
        let (numerator, denominator) = (value.numer(), value.denom());
        let missing = BITS + denominator.bits() + 1;
        let shift = missing.saturating_sub(numerator.bits());
        Wide::cut((numerator << shift) / denominator, -(shift as i64))
    }

    /// An exact constant.
    pub fn from_exact(constant: &Exact) -> Wide {
        let rational = &mut |value: &Rational| Some(Wide::from_rational(value));
        let value = constant.map(rational, &mut Wide::sincos);
        value.unwrap_or_else(Wide::zero)
    }

    /// Sine and cosine of an angle, each within 2⁻²⁵⁵ of the true value.
    pub fn sincos(angle: &Angle) -> SinCosPair<Wide> {
        let bits = BITS as usize + 16;
        let (sin, cos) = sin_cos(angle, bits);
        SinCosPair {
            sin: Wide::cut(sin, -(bits as i64)),
            cos: Wide::cut(cos, -(bits as i64)),
        }
    }

    /// The same number, exactly.
    pub fn to_rational(&self) -> Rational {
        let power = self.exponent.unsigned_abs();
        match self.exponent < 0 {
            true => Rational::new(self.significand.clone(), BigInt::one() << power),
            false => Rational::from_integer(&self.significand << power),
        }
    }

    /// The square root, zero of what is negative.
    #[must_use]
    pub fn sqrt(&self) -> Wide {
        if !self.significand.is_positive() {
            return Wide::zero();
        }
        // Twice the bits, and an even exponent.
        let missing = (2 * BITS + 2).saturating_sub(self.significand.bits()) as i64;
        let shift = missing + (self.exponent - missing).rem_euclid(2);
        let root = (&self.significand << shift).sqrt();
        Wide::cut(root, (self.exponent - shift) / 2)
    }

    /// self / other; `None` if that is zero.
    pub fn over(&self, other: &Wide) -> Option<Wide> {
        if other.significand.is_zero() {
            return None;
        }
        let shift = BITS + other.significand.bits() + 1;
        let quotient = (&self.significand << shift) / &other.significand;
        let exponent = self.exponent - other.exponent - shift as i64;
        Some(Wide::cut(quotient, exponent))
    }

    /// Whether it is below zero.
    pub fn is_negative(&self) -> bool {
        self.significand.is_negative()
    }

    /// |self|, rounded up to a double.
    pub fn magnitude(&self) -> f64 {
        let size = self.significand.abs();
        let drop = size.bits().saturating_sub(53);
        let top: BigInt = &size >> drop;
        let is_exact = (&top << drop) == size;
        let top = top + u32::from(!is_exact);
        let top = top.to_f64().unwrap_or(f64::INFINITY);
        let exponent = self.exponent.saturating_add(drop as i64);
        let exponent = exponent.clamp(-4000, 4000) as i32;
        let value = libm::ldexp(top, exponent);
        // What is below the least normal double has been rounded on the way.
        if value < f64::MIN_POSITIVE && !size.is_zero() {
            value.next_up()
        } else {
            value
        }
    }

    fn cut(significand: BigInt, exponent: i64) -> Wide {
        let extra = significand.bits().saturating_sub(BITS);
        Wide {
            exponent: if significand.is_zero() {
                0
            } else {
                exponent.saturating_add(extra as i64)
            },
            significand: significand >> extra,
        }
    }

    fn sum(&self, other: &Wide, minus: bool) -> Wide {
        let signed = |value: &Wide| match minus {
            true => value.neg(),
            false => value.clone(),
        };
        if self.is_zero() {
            return signed(other);
        }
        if other.is_zero() {
            return self.clone();
        }
        let other = signed(other);
        let (high, low) = match self.exponent >= other.exponent {
            true => (self, &other),
            false => (&other, self),
        };
        let gap = high.exponent.abs_diff(low.exponent);
        if gap > 2 * BITS {
            // The other is less than the last bit.
            return high.clone();
        }
        Wide::cut((&high.significand << gap) + &low.significand, low.exponent)
    }
}

impl Scalar for Wide {
    fn zero() -> Self {
        Wide {
            significand: BigInt::zero(),
            exponent: 0,
        }
    }
    fn one() -> Self {
        Wide {
            significand: BigInt::one(),
            exponent: 0,
        }
    }
    fn add(&self, other: &Self) -> Self {
        self.sum(other, false)
    }
    fn sub(&self, other: &Self) -> Self {
        self.sum(other, true)
    }
    fn mul(&self, other: &Self) -> Self {
        Wide::cut(
            &self.significand * &other.significand,
            self.exponent.saturating_add(other.exponent),
        )
    }
    fn neg(&self) -> Self {
        Wide {
            significand: -&self.significand,
            exponent: self.exponent,
        }
    }
    fn half(&self) -> Self {
        match self.is_zero() {
            true => self.clone(),
            false => Wide {
                significand: self.significand.clone(),
                exponent: self.exponent.saturating_sub(1),
            },
        }
    }
    fn is_zero(&self) -> bool {
        self.significand.is_zero()
    }
}

impl Divide for Wide {
    /// By zero: zero, for want of an infinity.
    fn div(&self, other: &Self) -> Self {
        if other.is_zero() {
            return Self::zero();
        }
        // The quotient has the bits of a significand and one more.
        let missing = BITS + 1 + other.significand.bits();
        let shift = missing.saturating_sub(self.significand.bits());
        let exponent = self.exponent.saturating_sub(other.exponent);
        Wide::cut(
            (&self.significand << shift) / &other.significand,
            exponent.saturating_sub(shift as i64),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ratio(n: i64, d: i64) -> Wide {
        Wide::from_rational(&Rational::new(n.into(), d.into()))
    }

    #[test]
    fn it_is_exact_to_76_digits() {
        let third = ratio(1, 3);
        let one = third.add(&third).add(&third);
        let off = one.sub(&Wide::one()).magnitude();
        assert!(off < 1e-76, "{off:e}");
        let angle = Angle::Radians(Rational::new(7.into(), 5.into()));
        let SinCosPair { sin, cos } = Wide::sincos(&angle);
        let circle = sin.mul(&sin).add(&cos.mul(&cos)).sub(&Wide::one());
        assert!(circle.magnitude() < 1e-76);
        assert!(
            sin.sub(&Wide::from_f64(libm::sin(1.4)).unwrap())
                .magnitude()
                < 3e-16
        );
    }

    #[test]
    fn quotients_are_as_exact() {
        let (seven, third) = (ratio(7, 1), ratio(1, 3));
        let off = seven.div(&third).sub(&ratio(21, 1)).magnitude();
        assert!(off < 1e-74, "{off:e}");
        assert_eq!(ratio(-6, 1).div(&ratio(4, 1)), ratio(-3, 2));
        assert_eq!(seven.div(&Wide::zero()), Wide::zero());
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

    #[test]
    fn what_is_far_smaller_is_nothing_beside_it() {
        let (one, tiny) = (Wide::one(), Wide::from_f64(1e-300).unwrap());
        assert_eq!(one.add(&tiny), one);
        assert_eq!(one.sub(&one), Wide::zero());
        assert_eq!(tiny.sub(&Wide::zero()), tiny);
        assert_eq!(Wide::zero().sub(&tiny), tiny.neg());
        assert_eq!(one.half().add(&one.half()).sub(&one), Wide::zero());
    }
}
