//! Integers modulo a prime that is chosen at run time.
//!
//! Zero and one need no context in a [`Scalar`], so a residue is either known
//! modulo a [`Prime`], or a dyadic rational that has met none yet: it takes
//! the prime of the first residue that it meets.

use num_bigint::{BigInt, Sign};
use num_rational::BigRational;
use num_traits::Zero;

use super::dyadic::Dyadic;
use super::prime::Prime;
use super::{Divide, Scalar, SinCosPair};

/// A residue, or a number that has met no prime yet.
#[derive(Clone, Copy, Debug)]
pub struct Residue(Form);

#[derive(Clone, Copy, Debug)]
enum Form {
    /// A number of no prime yet.
    Free(Dyadic),
    /// x·2⁶⁴ mod p
    Of(Prime, u64),
    /// A mixture of two primes, a free number beyond its range, or a quotient by zero:
    /// equal to nothing.
    Lost,
}

impl Residue {
    /// Returns the residue of an integer.
    pub fn new(prime: Prime, x: u64) -> Residue {
        Residue(Form::Of(prime, prime.enter(x)))
    }

    /// Returns the residue of a rational: `None` if the prime divides its denominator,
    /// or its numerator without its being zero. Zero needs no prime.
    pub fn of_rational(prime: Prime, x: &BigRational) -> Option<Residue> {
        if x.is_zero() {
            return Some(Residue::zero());
        }
        let [numerator, denominator] = [x.numer(), x.denom()].map(|x| modulo(prime, x));
        if numerator == 0 || denominator == 0 {
            return None;
        }
        let inverse = prime.pow(prime.enter(denominator), prime.modulus() - 2);
        let value = prime.mul(prime.enter(numerator), inverse);
        Some(Residue(Form::Of(prime, value)))
    }

    /// Returns the residue as an integer in 0 … p − 1; `None` if it is of another
    /// prime, or lost.
    pub fn value(&self, prime: Prime) -> Option<u64> {
        match self.0 {
            Form::Of(own, value) if own == prime => Some(prime.leave(value)),
            Form::Free(x) => Some(prime.leave(attached(prime, x))),
            _ => None,
        }
    }

    /// Returns (sin, cos) = (2t, 1 − t²) / (1 + t²), a point of the circle.
    ///
    /// The denominator is never zero if p ≡ 3 (mod 4): −1 is no square then.
    pub fn circle_point(prime: Prime, t: u64) -> SinCosPair<Residue> {
        let (one, t) = (prime.enter(1), prime.enter(t));
        let square = prime.mul(t, t);
        let scale = prime.pow(prime.add(one, square), prime.modulus() - 2);
        let of = |x: u64| Residue(Form::Of(prime, prime.mul(x, scale)));
        SinCosPair {
            sin: of(prime.add(t, t)),
            cos: of(prime.add(one, prime.neg(square))),
        }
    }

    fn free(x: Option<Dyadic>) -> Residue {
        Residue(x.map_or(Form::Lost, Form::Free))
    }

    fn zip(
        &self,
        other: &Residue,
        free: impl Fn(Dyadic, Dyadic) -> Option<Dyadic>,
        of: impl Fn(Prime, u64, u64) -> u64,
    ) -> Residue {
        match (self.0, other.0) {
            (Form::Of(p, a), Form::Of(q, b)) if p == q => Residue(Form::Of(p, of(p, a, b))),
            (Form::Of(p, a), Form::Free(b)) => Residue(Form::Of(p, of(p, a, attached(p, b)))),
            (Form::Free(a), Form::Of(p, b)) => Residue(Form::Of(p, of(p, attached(p, a), b))),
            (Form::Free(a), Form::Free(b)) => Residue::free(free(a, b)),
            _ => Residue(Form::Lost),
        }
    }
}

/// Returns the number as it is kept modulo p.
fn attached(prime: Prime, x: Dyadic) -> u64 {
    let size = match x.units() {
        0 => return 0,
        units => prime.enter(units.unsigned_abs()),
    };
    let value = if x.units() < 0 { prime.neg(size) } else { size };
    (0..x.halvings()).fold(value, |value, _| prime.half(value))
}

/// Returns an integer modulo a prime.
fn modulo(prime: Prime, x: &BigInt) -> u64 {
    let wide = u128::from(prime.modulus());
    let digits = x.magnitude().iter_u64_digits().rev();
    // The remainder is below p, so the sum is below 2¹²⁸.
    let size = digits.fold(0u128, |rest, digit| {
        ((rest << 64) | u128::from(digit)) % wide
    }) as u64;
    match x.sign() {
        Sign::Minus => prime.neg(size),
        _ => size,
    }
}

impl Scalar for Residue {
    fn zero() -> Self {
        Residue::free(Some(Dyadic::ZERO))
    }
    fn one() -> Self {
        Residue::free(Some(Dyadic::ONE))
    }
    fn add(&self, other: &Self) -> Self {
        self.zip(other, Dyadic::checked_add, Prime::add)
    }
    fn sub(&self, other: &Self) -> Self {
        self.add(&other.neg())
    }
    fn mul(&self, other: &Self) -> Self {
        self.zip(other, Dyadic::checked_mul, Prime::mul)
    }
    fn neg(&self) -> Self {
        Residue(match self.0 {
            Form::Free(x) => return Residue::free(x.checked_neg()),
            Form::Of(prime, value) => Form::Of(prime, prime.neg(value)),
            Form::Lost => Form::Lost,
        })
    }
    fn half(&self) -> Self {
        Residue(match self.0 {
            Form::Free(x) => return Residue::free(x.half()),
            Form::Of(prime, value) => Form::Of(prime, prime.half(value)),
            Form::Lost => Form::Lost,
        })
    }
    fn is_zero(&self) -> bool {
        matches!(self.0, Form::Free(x) if x.is_zero())
    }
    fn is_one(&self) -> bool {
        matches!(self.0, Form::Free(x) if x.is_one())
    }
}

impl Divide for Residue {
    /// Divides; by zero, or of two numbers that have met no prime: lost.
    fn div(&self, other: &Self) -> Self {
        let inverse = match other.0 {
            _ if other.is_one() => return *self,
            Form::Of(prime, value) if value != 0 => {
                Form::Of(prime, prime.pow(value, prime.modulus() - 2))
            }
            Form::Free(_) => match self.0 {
                Form::Of(prime, _) => match other.value(prime) {
                    Some(value) if value != 0 => {
                        let value = prime.enter(value);
                        Form::Of(prime, prime.pow(value, prime.modulus() - 2))
                    }
                    _ => Form::Lost,
                },
                _ => Form::Lost,
            },
            _ => Form::Lost,
        };
        self.mul(&Residue(inverse))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::field::Points;

    const P: u64 = (1 << 63) - 25;

    fn big(x: &Residue, prime: Prime) -> BigInt {
        x.value(prime).unwrap().into()
    }

    /// Expressions of free and attached numbers against big integers.
    #[test]
    fn is_arithmetic_of_big_integers() {
        let prime = Prime::new(P).unwrap();
        let mut points = Points::new(0x7e5);
        let p = BigInt::from(P);
        for _ in 0..2000 {
            let x = points.bits() % P;
            let (a, b) = (Residue::new(prime, x), Residue::one().double().neg());
            let (x, y) = (BigInt::from(x), BigInt::from(-2));
            let rest = |x: BigInt| ((x % &p) + &p) % &p;
            assert_eq!(big(&a.add(&b), prime), rest(&x + &y));
            assert_eq!(big(&b.sub(&a), prime), rest(&y - &x));
            assert_eq!(big(&a.mul(&b), prime), rest(&x * &y));
            assert_eq!(big(&a.neg(), prime), rest(-&x));
            assert_eq!(big(&a.half().double(), prime), x);
            let SinCosPair { sin, cos } = Residue::circle_point(prime, points.bits() % P);
            let one = sin.mul(&sin).add(&cos.mul(&cos));
            assert_eq!(one.value(prime), Some(1));
        }
    }

    #[test]
    fn rationals_that_vanish_have_no_residue() {
        let prime = Prime::new(P).unwrap();
        let of =
            |n: i128, d: i128| Residue::of_rational(prime, &BigRational::new(n.into(), d.into()));
        let third = of(-1, 3).unwrap();
        assert_eq!(third.add(&third).add(&third).value(prime), Some(P - 1));
        assert!(of(i128::from(P) * 3, 7).is_none());
        assert!(of(7, i128::from(P) * 3).is_none());
        assert_eq!(of(0, 7).unwrap().value(prime), Some(0));
        let wide = of(i128::MIN, 1).unwrap();
        let expected = (-BigInt::from(1u8) << 127u32) % P + P;
        assert_eq!(big(&wide, prime), expected);
    }

    #[test]
    fn free_numbers_fold_and_take_the_prime_that_they_meet() {
        let prime = Prime::new(P).unwrap();
        let quarter = Residue::one().half().half();
        assert!(Residue::zero().is_zero() && Residue::one().is_one() && !quarter.is_one());
        let sum = quarter.add(&Residue::one().half());
        let four = Residue::new(prime, 4);
        assert_eq!(sum.mul(&four).value(prime), Some(3));
        assert_eq!(sum.mul(&sum).mul(&four).mul(&four).value(prime), Some(9));
        // Nothing is wrapped: what is beyond a free number's range is lost,
        // and so is what is of two primes.
        let mut large = Residue::one();
        for _ in 0..64 {
            large = large.double();
        }
        assert_eq!(large.value(prime), None);
        let other = Residue::new(Prime::new(7).unwrap(), 3);
        assert_eq!(other.add(&four).value(prime), None);
        assert_eq!(four.add(&large).value(prime), None);
    }
}
