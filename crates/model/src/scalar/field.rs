//! Integers modulo a prime p just below 2⁶¹.
//!
//! Two formulas that agree at a random point of the field are the same rational function but for a
//! chance of at most degree/p. There are two primes, so that what was found by one is checked by the
//! other: a false constant that the first cannot tell from the true one the second can.

use num_bigint::{BigInt, Sign};
use num_rational::BigRational;

use super::{Divide, Scalar, SinCosPair};
use crate::number::Angle;

/// A residue modulo a prime, kept below it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Default)]
pub struct Modulo<const PRIME: u64>(u64);

/// The field of searches: integers modulo 2⁶¹ − 1.
pub type Field = Modulo<{ (1 << 61) - 1 }>;

/// The field of proofs, and of the second look at what searches find: integers modulo 2⁶¹ − 465.
pub type ProofField = Modulo<{ (1 << 61) - 465 }>;

impl<const PRIME: u64> Modulo<PRIME> {
    /// The prime.
    pub const P: u64 = PRIME;
    /// 0
    pub const ZERO: Self = Modulo(0);
    /// 1
    pub const ONE: Self = Modulo(1);
    /// 2⁶¹ modulo the prime.
    const EXCESS: u64 = {
        assert!(PRIME < 1 << 61 && PRIME > (1 << 61) - (1 << 10) && PRIME % 8 == 7);
        (1 << 61) - PRIME
    };

    /// Returns the residue of a non-negative integer.
    pub const fn new(x: u64) -> Self {
        Modulo(x % PRIME)
    }

    /// Returns the residue of an integer.
    pub fn from_i64(x: i64) -> Self {
        let size = Self::new(x.unsigned_abs());
        if x < 0 { size.neg() } else { size }
    }

    /// Returns the residue of a rational, `None` if p divides its denominator.
    pub fn from_rational(x: &BigRational) -> Option<Self> {
        let inverse = Self::residue(x.denom()).inverse()?;
        Some(Self::residue(x.numer()).mul(&inverse))
    }

    /// Returns the residue as an integer in 0 … p − 1.
    pub const fn value(self) -> u64 {
        self.0
    }

    /// Returns `self` to a power.
    pub fn pow(self, mut exponent: u64) -> Self {
        let (mut base, mut power) = (self, Self::ONE);
        while exponent > 0 {
            if exponent & 1 == 1 {
                power = power.mul(&base);
            }
            base = base.mul(&base);
            exponent >>= 1;
        }
        power
    }

    /// Returns 1/x, `None` for 0.
    pub fn inverse(self) -> Option<Self> {
        // Fermat: x^(p−1) = 1.
        (self.0 != 0).then(|| self.pow(Self::P - 2))
    }

    /// Returns (sin, cos) = (2t, 1 − t²) / (1 + t²), a point of the circle.
    ///
    /// Every point but (0, −1) has its t. As p ≡ 3 (mod 4), −1 is no square: nothing divides by 0.
    pub fn circle_point(t: Self) -> (Self, Self) {
        let square = t.mul(&t);
        let scale = Self::ONE.add(&square).pow(Self::P - 2);
        let sin = t.double().mul(&scale);
        let cos = Self::ONE.sub(&square).mul(&scale);
        (sin, cos)
    }

    /// Returns sine and cosine of a constant angle, with the relations that [`Exact`] knows: for π/4
    /// both are √½, a residue since the prime is of the form 8k − 1; other angles have the point of
    /// the circle that `other` draws.
    ///
    /// [`Exact`]: crate::number::Exact
    pub fn of_angle(angle: &Angle, other: impl FnOnce() -> (Self, Self)) -> SinCosPair<Self> {
        let (sin, cos) = if angle.is_eighth() {
            let root = Self::ONE.half().pow(PRIME.div_ceil(4));
            (root, root)
        } else {
            other()
        };
        SinCosPair { sin, cos }
    }

    /// `x` is below 2p.
    const fn reduced(x: u64) -> Self {
        Modulo(if x >= PRIME { x - PRIME } else { x })
    }

    fn residue(x: &BigInt) -> Self {
        let shift = Modulo(Self::EXCESS << 3); // 2⁶⁴
        let words = x.iter_u64_digits().rev().map(Self::new);
        let size = words.fold(Self::ZERO, |sum, word| sum.mul(&shift).add(&word));
        match x.sign() {
            Sign::Minus => size.neg(),
            Sign::Plus | Sign::NoSign => size,
        }
    }
}

impl<const PRIME: u64> Scalar for Modulo<PRIME> {
    fn zero() -> Self {
        Self::ZERO
    }
    fn one() -> Self {
        Self::ONE
    }
    fn add(&self, other: &Self) -> Self {
        // Both are below 2⁶¹: no overflow.
        Self::reduced(self.0 + other.0)
    }
    fn mul(&self, other: &Self) -> Self {
        let product = u128::from(self.0) * u128::from(other.0);
        // The part above 2⁶¹ counts EXCESS times. The sum is below 2⁷¹, and again.
        const LOW: u128 = (1 << 61) - 1;
        let fold = |x: u128| (x & LOW) + (x >> 61) * u128::from(Self::EXCESS);
        let once = fold(product);
        Self::reduced(if Self::EXCESS == 1 { once } else { fold(once) } as u64)
    }
    fn neg(&self) -> Self {
        Modulo(if self.0 == 0 { 0 } else { PRIME - self.0 })
    }
    fn half(&self) -> Self {
        // p is odd: one of x and x + p is even.
        Modulo((self.0 + (self.0 & 1) * PRIME) >> 1)
    }
}

impl<const PRIME: u64> Divide for Modulo<PRIME> {
    /// Returns the quotient; zero for a divisor of zero, which [`divides`](Divide::divides) tells.
    fn div(&self, other: &Self) -> Self {
        other.inverse().map_or(Self::ZERO, |x| self.mul(&x))
    }
    fn divides(&self) -> bool {
        self.0 != 0
    }
}

/// A reproducible sequence of points: SplitMix64 (Steele, Lea, Flood 2014).
#[derive(Clone, Debug)]
pub struct Points(u64);

impl Points {
    /// Returns the sequence of a seed.
    pub const fn new(seed: u64) -> Self {
        Points(seed)
    }

    /// Returns the next 64 bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// Returns a residue, each equally likely.
    pub fn field(&mut self) -> Field {
        loop {
            // The one value that is no residue is drawn once in 2⁶¹ times.
            let x = self.bits() >> 3;
            if x < Field::P {
                return Modulo(x);
            }
        }
    }

    /// Returns a point of the circle: (sin, cos) of [`Field::circle_point`].
    pub fn circle(&mut self) -> (Field, Field) {
        Field::circle_point(self.field())
    }

    /// Returns a number in [−1, 1), for tests in floating point.
    pub fn unit(&mut self) -> f64 {
        // 53 bits: exact in f64.
        let x = (self.bits() >> 11) as f64;
        x / (1u64 << 52) as f64 - 1.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn are_fields() {
        is_a_field::<{ Field::P }>();
        is_a_field::<{ ProofField::P }>();
    }

    fn is_a_field<const PRIME: u64>() {
        type Own<const PRIME: u64> = Modulo<PRIME>;
        let (one, zero) = (Own::<PRIME>::ONE, Own::<PRIME>::ZERO);
        let mut points = Points::new(1);
        let mut draw = || Own::<PRIME>::new(points.bits());
        for _ in 0..1000 {
            let [a, b, c] = [draw(), draw(), draw()];
            assert_eq!(a.mul(&b.add(&c)), a.mul(&b).add(&a.mul(&c)));
            assert_eq!(a.half().double(), a);
            assert_eq!(a.sub(&b).add(&b), a);
            assert_eq!(a.mul(&a.inverse().unwrap()), one);
            let wide = u128::from(a.0) * u128::from(b.0) % u128::from(PRIME);
            assert_eq!(u128::from(a.mul(&b).0), wide);
            let (sin, cos) = Own::circle_point(a);
            assert_eq!(sin.mul(&sin).add(&cos.mul(&cos)), one);
        }
        let eighth = Angle::PiTimes(BigRational::new(1.into(), 4.into()));
        let pair = Own::<PRIME>::of_angle(&eighth, || (zero, zero));
        assert_eq!(pair.sin.mul(&pair.cos).double(), one);
        assert_eq!(pair.sin, pair.cos);
        let top = zero.sub(&one);
        assert_eq!(top.0, PRIME - 1);
        assert_eq!(top.mul(&top), one);
        assert_eq!(top.add(&one), zero);
        assert_eq!(zero.neg(), zero);
        assert_eq!(zero.inverse(), None);
        assert_eq!(Own::from_i64(-1), top);
        let least = BigRational::from_integer(BigInt::from(i64::MIN));
        let least = Own::<PRIME>::from_rational(&least).unwrap();
        assert_eq!(Own::<PRIME>::from_i64(i64::MIN), least);
        let third = BigRational::new(BigInt::from(-1), BigInt::from(3));
        let residue = Own::<PRIME>::from_rational(&third).unwrap();
        assert_eq!(residue.mul(&Own::new(3)), top);
        let pole = BigRational::new(BigInt::from(1), BigInt::from(PRIME));
        assert_eq!(Own::<PRIME>::from_rational(&pole), None);
        for base in [-9_876_543_210_987_654_321_i128, 3] {
            let large = num_traits::pow(BigInt::from(base), 40);
            let small = Own::<PRIME>::from_rational(&BigInt::from(base).into()).unwrap();
            let quotient = BigRational::new(-large.clone(), &large + 1);
            let power = small.pow(40);
            let expected = power.neg().mul(&power.add(&one).inverse().unwrap());
            assert_eq!(Own::from_rational(&quotient), Some(expected));
        }
    }
}
