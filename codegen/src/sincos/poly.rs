//! Polynomials with dyadic coefficients, exactly, and their Chebyshev form.
//!
//! Every float is an integer over a power of two, so sums, products and changes of variable need
//! neither division nor rounding: the bounds found with them are proofs.

use num_bigint::BigInt;
use num_traits::float::FloatCore;
use num_traits::{One, Signed, Zero};

use dalembert_model::number::{Rational, Rounded};

/// Σ c_k·x^k with c_k = `coefficients[k]`·2^−`exponent`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Poly {
    coefficients: Vec<BigInt>,
    exponent: u64,
}

/// The bits that are kept behind the point, at least.
const BITS: u64 = 120;

/// Returns the bits that each unit of the degree adds to a power of a number up to `reach`.
fn digits(reach: f64) -> u64 {
    libm::ceil(libm::log2(reach.max(1.0))) as u64 + 1
}

impl Poly {
    pub(crate) fn integers(coefficients: Vec<BigInt>) -> Poly {
        Poly::new(coefficients, 0)
    }

    pub(crate) fn constant(value: f64) -> Option<Poly> {
        if !value.is_finite() {
            return None;
        }
        let (mantissa, exponent, sign) = FloatCore::integer_decode(value);
        let mantissa = (BigInt::from(mantissa) * sign) << exponent.max(0);
        let exponent = exponent.min(0).unsigned_abs();
        Some(Poly::new(vec![mantissa], exponent.into()))
    }

    pub(crate) fn variable() -> Poly {
        Poly::integers(vec![BigInt::zero(), BigInt::one()])
    }

    pub(crate) fn degree(&self) -> usize {
        self.coefficients.len().saturating_sub(1)
    }

    pub(crate) fn bits(&self) -> u64 {
        let numerators = self.coefficients.iter().map(BigInt::bits).max();
        numerators.unwrap_or(0) + self.exponent
    }

    /// The fraction is not in lowest terms: they take longer than all that is done with it.
    pub(crate) fn coefficient(&self, k: usize) -> Rational {
        let numerator = self.coefficients.get(k).cloned().unwrap_or_default();
        Rational::new_raw(numerator, BigInt::one() << self.exponent)
    }

    pub(crate) fn add(&self, other: &Poly) -> Poly {
        let exponent = self.exponent.max(other.exponent);
        let (a, b) = (self.at(exponent), other.at(exponent));
        let len = a.len().max(b.len());
        let term = |list: &[BigInt], k: usize| list.get(k).cloned().unwrap_or_default();
        let coefficients = (0..len).map(|k| term(&a, k) + term(&b, k));
        Poly::new(coefficients.collect(), exponent)
    }

    pub(crate) fn sub(&self, other: &Poly) -> Poly {
        self.add(&other.scaled(&BigInt::from(-1)))
    }

    pub(crate) fn mul(&self, other: &Poly) -> Poly {
        let len = self.coefficients.len() + other.coefficients.len();
        let mut coefficients = vec![BigInt::zero(); len];
        for (i, a) in self.coefficients.iter().enumerate() {
            for (j, b) in other.coefficients.iter().enumerate() {
                coefficients[i + j] += a * b;
            }
        }
        Poly::new(coefficients, self.exponent + other.exponent)
    }

    pub(crate) fn scaled(&self, factor: &BigInt) -> Poly {
        let coefficients = self.coefficients.iter().map(|c| c * factor);
        Poly::new(coefficients.collect(), self.exponent)
    }

    pub(crate) fn compose(&self, inner: &Poly) -> Poly {
        let mut sum = Poly::integers(Vec::new());
        for c in self.coefficients.iter().rev() {
            let constant = Poly::new(vec![c.clone()], self.exponent);
            sum = sum.mul(inner).add(&constant);
        }
        sum
    }

    /// Cuts the coefficients to few bits; also the most that this changes for |x| up to `reach`.
    pub(crate) fn divided(&self, divisor: &BigInt, reach: f64) -> (Poly, f64) {
        let exponent = BITS + digits(reach) * self.degree() as u64;
        let divisor = divisor << self.exponent;
        let cut = |c: &BigInt| (c << exponent) / &divisor;
        let coefficients: Vec<BigInt> = self.coefficients.iter().map(cut).collect();
        // Each is off by less than one unit, and each power of x below the
        // highest one's bound: Σ 2^−exponent·reach^k ≤ terms·2^−BITS.
        let error = coefficients.len() as f64 * libm::exp2(-(BITS as f64));
        let poly = Poly {
            coefficients,
            exponent,
        };
        (poly, error)
    }

    /// Returns p((centre + radius·y)/2^`bits`) as a polynomial in y, of a p that is
    /// [divided](Poly::divided), and the most by which it is off for |y| ≤ 1: then x is in the reach
    /// for which p was divided.
    pub(crate) fn on(&self, centre: i64, radius: i64, bits: u64) -> (Poly, f64) {
        let mut sum: Vec<BigInt> = Vec::with_capacity(self.coefficients.len());
        for c in self.coefficients.iter().rev() {
            // sum·(centre + radius·y)/2^bits + c, in the units of c.
            sum.push(BigInt::zero());
            for k in (0..sum.len()).rev() {
                sum[k] *= centre;
                if k > 0 {
                    let below = &sum[k - 1] * radius;
                    sum[k] += below;
                }
                sum[k] >>= bits;
            }
            sum[0] += c;
        }
        // Each step cuts less than a unit off each coefficient, and each of those that are left
        // multiplies by the reach at most: as above, with all coefficients for each step. At the
        // end as much again is cut.
        let terms = sum.len() as f64;
        let spare = self.exponent.saturating_sub(BITS);
        sum.iter_mut().for_each(|c| *c >>= spare);
        let poly = Poly {
            coefficients: sum,
            exponent: self.exponent - spare,
        };
        (poly, 2.0 * terms * terms * libm::exp2(-(BITS as f64)))
    }

    /// Returns the a_k of Σ a_k·T_k(x), by Horner's scheme with x·T_0 = T_1 and 2x·T_k = T_(k+1) +
    /// T_(k−1).
    pub(crate) fn chebyshev(&self) -> Poly {
        let mut sum: Vec<BigInt> = Vec::new();
        for (halvings, c) in self.coefficients.iter().rev().enumerate() {
            let mut next = vec![BigInt::zero(); sum.len() + 1];
            for (k, a) in sum.iter().enumerate() {
                next[k + 1] += a;
                next[k.abs_diff(1)] += a;
            }
            next[0] += c << halvings;
            sum = next;
        }
        Poly {
            coefficients: sum,
            exponent: self.exponent + self.degree() as u64,
        }
    }

    /// Returns Σ a_k·T_k for k up to a degree, as Σ c_k·x^k.
    pub(crate) fn in_powers(&self, degree: usize) -> Poly {
        let two_x = Poly::integers(vec![BigInt::zero(), BigInt::from(2)]);
        let (mut low, mut high) = (Poly::integers(vec![BigInt::one()]), Poly::variable());
        let mut sum = Poly::integers(Vec::new());
        for a in self.coefficients.iter().take(degree + 1) {
            sum = sum.add(&low.scaled(a));
            let next = two_x.mul(&high).sub(&low);
            low = std::mem::replace(&mut high, next);
        }
        Poly::new(sum.coefficients, sum.exponent + self.exponent)
    }

    /// Returns Σ |c_k| from the k-th coefficient on, over a divisor, rounded up. In the Chebyshev
    /// form this bounds |p| on \[−1, 1\], where no |T_k| exceeds one.
    pub(crate) fn sum_from(&self, k: usize, divisor: &BigInt) -> f64 {
        let sum: BigInt = self.coefficients.iter().skip(k).map(Signed::abs).sum();
        if sum.is_zero() {
            return 0.0;
        }
        f64::nearest_rational(&Rational::new_raw(sum, divisor << self.exponent)).next_up()
    }

    fn at(&self, exponent: u64) -> Vec<BigInt> {
        let by = exponent - self.exponent;
        self.coefficients.iter().map(|c| c << by).collect()
    }

    fn new(mut coefficients: Vec<BigInt>, exponent: u64) -> Poly {
        while coefficients.last().is_some_and(Zero::is_zero) {
            coefficients.pop();
        }
        let zeros = coefficients.iter().filter_map(BigInt::trailing_zeros);
        let shared = zeros.min().unwrap_or(exponent).min(exponent);
        coefficients.iter_mut().for_each(|c| *c >>= shared);
        Poly {
            coefficients,
            exponent: exponent - shared,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(coefficients: &[f64]) -> Poly {
        let x = Poly::variable();
        let mut sum = Poly::integers(Vec::new());
        for &c in coefficients.iter().rev() {
            sum = sum.mul(&x).add(&Poly::constant(c).unwrap());
        }
        sum
    }

    fn at(poly: &Poly, x: i64) -> Rational {
        let x = Rational::from_integer(x.into());
        let terms = (0..=poly.degree()).rev().map(|k| poly.coefficient(k));
        terms.fold(Rational::zero(), |sum, c| sum * &x + c)
    }

    #[test]
    fn arithmetic_is_that_of_values() {
        let (p, q) = (of(&[0.1, -3.0, 0.0, 1e-30]), of(&[1e20, 0.25]));
        for x in -3..4 {
            let (a, b) = (at(&p, x), at(&q, x));
            assert_eq!(at(&p.add(&q), x), &a + &b);
            assert_eq!(at(&p.sub(&q), x), &a - &b);
            assert_eq!(at(&p.mul(&q), x), &a * &b);
            assert_eq!(at(&p.compose(&of(&[2.0, -1.0])), x), at(&p, 2 - x));
        }
        let (cut, error) = p.divided(&BigInt::from(3), 3.0);
        let off = at(&cut, 3) - at(&p, 3) / Rational::from_integer(3.into());
        assert!(f64::nearest_rational(&off).abs() <= error && error < 1e-28);
        for (y, x) in [(-1, 1), (0, 2), (1, 3)] {
            let (moved, error) = cut.on(16, 8, 3);
            let off = at(&moved, y) - at(&cut, x);
            assert!(f64::nearest_rational(&off).abs() <= error && error < 1e-28);
        }
        assert_eq!(Poly::constant(f64::NAN), None);
    }

    #[test]
    fn chebyshev_there_and_back() {
        let p = of(&[0.1, -3.0, 0.5, 7.0, -0.3, 2.0]);
        let t = p.chebyshev();
        assert_eq!(t.in_powers(5), p);
        let cube = of(&[0.0, 0.0, 0.0, 1.0]).chebyshev();
        assert_eq!(cube.coefficient(1), Rational::new(3.into(), 4.into()));
        assert_eq!(cube.coefficient(3), Rational::new(1.into(), 4.into()));
        let bound = cube.sum_from(0, &BigInt::one());
        assert!((1.0..1.0 + 1e-15).contains(&bound));
    }
}
