//! Degrees of formulas, from above.
//!
//! A value is N/Π dᵉ with polynomials N and d in the inputs and in the sines and cosines of joints
//! and constant angles; divisors that are used again are the same d.

use std::rc::Rc;

use dalembert_model::scalar::{Divide, Scalar};

/// The degree of a polynomial over powers of divisors; infinite beyond a double's range.
#[derive(Clone, Debug, Default)]
pub(crate) struct Degree {
    pub(crate) top: f64,
    /// The degree of each divisor, which its address tells from others, and its power.
    under: Vec<(Rc<f64>, f64)>,
}

impl Degree {
    pub(crate) fn new(top: f64) -> Degree {
        let under = Vec::new();
        Degree { top, under }
    }

    fn powers(&self, other: &Degree) -> Vec<(Rc<f64>, f64, f64)> {
        let powers = self.under.iter().map(|(d, e)| (d.clone(), *e, 0.0));
        let others = other.under.iter().map(|(d, e)| (d.clone(), 0.0, *e));
        let mut divisors: Vec<_> = powers.chain(others).collect();
        // Stable: of two entries for one divisor, the one of `self` comes first.
        divisors.sort_by_key(|(divisor, ..)| Rc::as_ptr(divisor).addr());
        divisors.dedup_by(|second, first| {
            let is_same = Rc::ptr_eq(&second.0, &first.0);
            if is_same {
                first.2 = second.2;
            }
            is_same
        });
        divisors
    }
}

impl Scalar for Degree {
    fn zero() -> Self {
        Degree::default()
    }
    fn one() -> Self {
        Degree::default()
    }
    fn add(&self, other: &Self) -> Self {
        if self.under.is_empty() && other.under.is_empty() {
            return Degree::new(self.top.max(other.top));
        }
        let (mut a, mut b, mut under) = (self.top, other.top, Vec::new());
        for (divisor, in_a, in_b) in self.powers(other) {
            let power = in_a.max(in_b);
            a += (power - in_a) * *divisor;
            b += (power - in_b) * *divisor;
            under.push((divisor, power));
        }
        let top = a.max(b);
        Degree { top, under }
    }
    fn mul(&self, other: &Self) -> Self {
        let powers = self.powers(other).into_iter();
        let under = powers.map(|(d, a, b)| (d, a + b)).collect();
        let top = self.top + other.top;
        Degree { top, under }
    }
    fn neg(&self) -> Self {
        self.clone()
    }
    fn half(&self) -> Self {
        self.clone()
    }
}

impl Divide for Degree {
    /// Returns the degree of (N/Π dᵉ)/(M/Π dᶠ), which is N Π d^(f − e) over M.
    fn div(&self, other: &Self) -> Self {
        let mut top = self.top;
        let mut under = Vec::new();
        for (divisor, exponent, other_exponent) in self.powers(other) {
            if other_exponent > exponent {
                top += (other_exponent - exponent) * *divisor;
            } else if exponent > other_exponent {
                under.push((divisor, exponent - other_exponent));
            }
        }
        if other.top > 0.0 {
            under.push((Rc::new(other.top), 1.0));
        }
        Degree { top, under }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_divisor_counts_once() {
        let [x, y, z, w] = [1.0; 4].map(Degree::new);
        let inverse = Degree::one().div(&y);
        assert_eq!(x.mul(&inverse).add(&z.mul(&inverse)).top, 1.0);
        assert_eq!(x.mul(&inverse).add(&z.div(&w)).top, 2.0);
        assert_eq!(x.mul(&inverse).add(&z).top, 2.0);
        // 1/(x/y + z) is y/(x + z y).
        let nested = Degree::one().div(&x.mul(&inverse).add(&z));
        assert_eq!(nested.top, 1.0);
        assert_eq!(nested.add(&Degree::one()).top, 2.0);
    }

    #[test]
    fn powers_without_end_are_infinite() {
        let mut power = Degree::one().div(&Degree::new(1.0));
        for _ in 0..1100 {
            power = power.mul(&power);
        }
        let sum = power.add(&Degree::one()).top;
        assert!(sum.is_infinite() || sum.is_nan(), "{sum}");
    }
}
