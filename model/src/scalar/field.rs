//! Integers modulo the prime p = 2⁶¹ − 1.
//!
//! Two formulas that agree at a random point of the field are the same
//! rational function but for a chance of at most degree/p.

use num_bigint::{BigInt, Sign};
use num_rational::BigRational;

use super::{Divide, Scalar};

/// A residue modulo 2⁶¹ − 1, kept below it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Default)]
pub struct Field(u64);

impl Field {
    /// The prime 2⁶¹ − 1.
    pub const P: u64 = (1 << 61) - 1;
    /// 0
    pub const ZERO: Field = Field(0);
    /// 1
    pub const ONE: Field = Field(1);

    /// Returns the residue of a non-negative integer.
    pub const fn new(x: u64) -> Self {
        Field(x % Self::P)
    }

    /// Returns the residue of an integer.
    pub fn from_i64(x: i64) -> Self {
        let size = Self::new(x.unsigned_abs());
        if x < 0 { size.neg() } else { size }
    }

    /// Returns the residue of a rational, `None` if p divides its denominator.
    pub fn from_rational(x: &BigRational) -> Option<Self> {
        let inverse = residue(x.denom()).inverse()?;
        Some(residue(x.numer()).mul(&inverse))
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
    /// Every point but (0, −1) has its t. The denominator is never zero: −1 is
    /// no square modulo p ≡ 3 (mod 4).
    pub fn circle_point(t: Self) -> (Self, Self) {
        let square = t.mul(&t);
        let scale = Self::ONE.add(&square).pow(Self::P - 2);
        let sin = t.double().mul(&scale);
        let cos = Self::ONE.sub(&square).mul(&scale);
        (sin, cos)
    }
}

/// Returns the residue of an integer, word by word: 2⁶⁴ ≡ 8.
fn residue(x: &BigInt) -> Field {
    let words = x.iter_u64_digits().rev();
    let size = words.fold(Field::ZERO, |sum, word| {
        sum.mul(&Field(8)).add(&Field::new(word))
    });
    match x.sign() {
        Sign::Minus => size.neg(),
        Sign::Plus | Sign::NoSign => size,
    }
}

impl Scalar for Field {
    fn zero() -> Self {
        Self::ZERO
    }
    fn one() -> Self {
        Self::ONE
    }
    fn add(&self, other: &Self) -> Self {
        // Both are below 2⁶¹: no overflow.
        let sum = self.0 + other.0;
        Field(if sum >= Self::P { sum - Self::P } else { sum })
    }
    fn sub(&self, other: &Self) -> Self {
        self.add(&other.neg())
    }
    fn mul(&self, other: &Self) -> Self {
        let product = u128::from(self.0) * u128::from(other.0);
        // 2⁶¹ ≡ 1: the high part counts as it stands.
        let low = (product as u64) & Self::P;
        let high = (product >> 61) as u64;
        Field(low).add(&Field(high))
    }
    fn neg(&self) -> Self {
        Field(if self.0 == 0 { 0 } else { Self::P - self.0 })
    }
    fn half(&self) -> Self {
        // p is odd: one of x and x + p is even.
        let even = if self.0 & 1 == 0 {
            self.0
        } else {
            self.0 + Self::P
        };
        Field(even >> 1)
    }
}

impl Divide for Field {
    /// Returns the quotient; zero where the divisor is zero, which proofs exclude by
    /// [`divides`](Divide::divides).
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
                return Field(x);
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
    use num_bigint::BigInt;

    use super::*;

    #[test]
    fn is_the_field() {
        let mut points = Points::new(1);
        for _ in 0..1000 {
            let [a, b, c] = [points.field(), points.field(), points.field()];
            assert_eq!(a.mul(&b.add(&c)), a.mul(&b).add(&a.mul(&c)));
            assert_eq!(a.half().double(), a);
            assert_eq!(a.sub(&b).add(&b), a);
            assert_eq!(a.mul(&a.inverse().unwrap()), Field::ONE);
            let wide = u128::from(a.0) * u128::from(b.0) % u128::from(Field::P);
            assert_eq!(u128::from(a.mul(&b).0), wide);
            let (sin, cos) = Field::circle_point(a);
            assert_eq!(sin.mul(&sin).add(&cos.mul(&cos)), Field::ONE);
        }
        let top = Field::ZERO.sub(&Field::ONE);
        assert_eq!(top.0, Field::P - 1);
        assert_eq!(top.mul(&top), Field::ONE);
        assert_eq!(top.add(&Field::ONE), Field::ZERO);
        assert_eq!(Field::ZERO.neg(), Field::ZERO);
        assert_eq!(Field::ZERO.inverse(), None);
    }

    #[test]
    fn takes_integers_and_rationals() {
        assert_eq!(Field::from_i64(-1).add(&Field::ONE), Field::ZERO);
        assert_eq!(Field::from_i64(i64::MIN), Field::from_i64(-4));
        let third = BigRational::new(BigInt::from(-1), BigInt::from(3));
        let residue = Field::from_rational(&third).unwrap();
        assert_eq!(residue.mul(&Field::new(3)), Field::from_i64(-1));
        let pole = BigRational::new(BigInt::from(1), BigInt::from(Field::P));
        assert_eq!(Field::from_rational(&pole), None);
        // Beyond a word: powers of what is a word.
        for base in [-9_876_543_210_987_654_321_i128, 3] {
            let large = num_traits::pow(BigInt::from(base), 40);
            let small = Field::from_rational(&BigInt::from(base).into()).unwrap();
            let quotient = BigRational::new(-large.clone(), &large + 1);
            let expected = small
                .pow(40)
                .neg()
                .mul(&small.pow(40).add(&Field::ONE).inverse().unwrap());
            assert_eq!(Field::from_rational(&quotient), Some(expected));
        }
    }
}
