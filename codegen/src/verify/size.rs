//! Sizes of coefficients and common denominators, from above, in integers.

use dalembert_model::number::Rational;
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Zero};

/// A common denominator of more bits is no longer looked for: what does not
/// divide the one there is multiplies it.
const MAX_BITS: u64 = 4096;

/// An upper bound of a positive number: mantissa · 2^exponent, with 32 bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Size {
    /// From 2³¹ to 2³² − 1.
    mantissa: u64,
    exponent: i64,
}

impl Size {
    /// 1
    pub(crate) const ONE: Size = Size {
        mantissa: 1 << 31,
        exponent: -31,
    };

    /// Returns the size of a rational's magnitude: a power of two, at most four times as large.
    pub(crate) fn of(x: &Rational) -> Size {
        let [numerator, denominator] = [x.numer(), x.denom()].map(|x| x.bits() as i64);
        let bits = match x.is_integer() && numerator == 1 {
            true => 0,
            false => numerator - denominator + 1,
        };
        Size {
            exponent: Size::ONE.exponent + bits,
            ..Size::ONE
        }
    }

    /// Returns a + b
    pub(crate) fn add(self, other: Size) -> Size {
        let (large, small) = match self.exponent >= other.exponent {
            true => (self, other),
            false => (other, self),
        };
        let shift = large.exponent.saturating_sub(small.exponent).min(32);
        let shifted = (small.mantissa + ((1 << shift) - 1)) >> shift;
        Size::rounded(large.mantissa + shifted, large.exponent)
    }

    /// Returns a · b
    pub(crate) fn mul(self, other: Size) -> Size {
        let exponent = self.exponent.saturating_add(other.exponent);
        Size::rounded(self.mantissa * other.mantissa, exponent)
    }

    /// Returns the least n with 2^n not below it, or 0.
    pub(crate) fn bits(self) -> u64 {
        let whole = self.mantissa == 1 << 31;
        let bits = self.exponent.saturating_add(if whole { 31 } else { 32 });
        u64::try_from(bits).unwrap_or(0)
    }

    /// Returns a mantissa of at least 32 bits, rounded up to 32.
    fn rounded(mantissa: u64, exponent: i64) -> Size {
        let shift = 32 - mantissa.leading_zeros();
        let shifted = u128::from(mantissa) + ((1 << shift) - 1);
        let up = (shifted >> shift) as u64;
        // All ones that were rounded up: the next power of two.
        let carry = up >> 32;
        Size {
            mantissa: up >> carry,
            exponent: exponent.saturating_add((u64::from(shift) + carry) as i64),
        }
    }
}

/// A common denominator of constants, and how large it is.
#[derive(Clone, Debug)]
pub struct Denominators {
    common: BigInt,
    /// The bits of those that multiply it.
    more: u64,
}

impl Default for Denominators {
    fn default() -> Self {
        Denominators {
            common: BigInt::one(),
            more: 0,
        }
    }
}

impl Denominators {
    /// Takes a constant in; whether it is no integer.
    pub fn note(&mut self, x: &Rational) -> bool {
        let new = x.denom();
        if new.is_one() {
            return false;
        }
        if new.bits() > MAX_BITS {
            self.more = self.more.saturating_add(new.bits());
        } else if !(&self.common % new).is_zero() {
            let common = self.common.lcm(new);
            match common.bits() > MAX_BITS {
                true => self.more = self.more.saturating_add(new.bits()),
                false => self.common = common,
            }
        }
        true
    }

    /// Returns the bits of the common denominator.
    pub fn bits(&self) -> u64 {
        self.common.bits().saturating_add(self.more)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(size: Size) -> f64 {
        size.mantissa as f64 * 2f64.powi(size.exponent as i32)
    }

    /// Never below, and near.
    #[test]
    fn sizes_are_upper_bounds() {
        let mut random = crate::random::Random::new(0x517e);
        for _ in 0..2000 {
            let mut draw = || {
                let bits = (random.unit() * 60.0) as u32;
                let of = |x: f64| BigInt::from((x * 2f64.powi(bits as i32)) as i64 + 1);
                Rational::new(of(random.unit()), of(random.unit()))
            };
            let (x, y) = (draw(), draw());
            let (a, b) = (Size::of(&x), Size::of(&y));
            let exact = |x: &Rational| num_traits::ToPrimitive::to_f64(x).unwrap();
            assert!(value(a) >= exact(&x) && value(a) <= 4.0 * exact(&x), "{x}");
            let (sum, product) = (value(a) + value(b), value(a) * value(b));
            for (found, exact) in [(a.add(b), sum), (a.mul(b), product), (b.add(a), sum)] {
                assert!(value(found) >= exact && value(found) <= exact * (1.0 + 1e-9));
                let bits = exact.log2().ceil().max(0.0) as u64;
                assert!(
                    found.bits() >= bits && found.bits() <= bits + 1,
                    "{found:?}"
                );
                assert!((1 << 31..1 << 32).contains(&found.mantissa));
            }
        }
        // Rounded up to the next power of two.
        let ones = Size {
            mantissa: (1 << 32) - 1,
            exponent: 0,
        };
        let tiny = Size {
            mantissa: 1 << 31,
            exponent: -200,
        };
        assert_eq!(value(ones.add(tiny)), 2f64.powi(32));
        assert_eq!(Size::ONE.bits(), 0);
        assert_eq!(Size::ONE.add(Size::ONE).bits(), 1);
    }

    #[test]
    fn denominators_are_common() {
        let mut all = Denominators::default();
        let of = |n: i64, d: i64| Rational::new(n.into(), d.into());
        assert!(!all.note(&of(3, 1)) && all.note(&of(1, 100)) && all.note(&of(7, 1000)));
        assert_eq!(all.bits(), 10);
        all.note(&of(1, 3));
        assert_eq!(all.bits(), 12);
        let long = Rational::new(1.into(), (BigInt::one() << 5000u32) + 1);
        all.note(&long);
        assert_eq!(all.bits(), 12 + 5001);
    }
}
