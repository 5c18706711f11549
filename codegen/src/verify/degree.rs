//! Degrees of formulas and programs, from above.
//!
//! A value is N/Π dᵉ with polynomials N and d in the inputs and in the sines and cosines of
//! joints and constant angles; divisors that are used again are the same d. Two values differ by
//! a polynomial of degree k over a product of divisors, which do not vanish where both have
//! values. With each of m pairs a rational function of one parameter, (2t, 1 − t²)/(1 + t²), that
//! polynomial becomes one of degree at most (2m + 1)·k in the parameters that are drawn.

use std::cell::RefCell;
use std::rc::Rc;

use dalembert_model::equations::SinCosPair;
use dalembert_model::number::{Angle, Exact};
use dalembert_model::scalar::sparse::Sparse;
use dalembert_model::scalar::{Divide, Scalar};

use crate::dag::Leaves;
use crate::program::Input;

/// The degree of a polynomial over powers of divisors; infinite beyond a double's range.
#[derive(Clone, Debug, Default)]
pub(super) struct Degree {
    top: f64,
    /// The degree of each divisor and its power, ordered by address.
    under: Vec<(Rc<f64>, f64)>,
}

impl Degree {
    fn new(top: f64) -> Degree {
        Degree {
            top,
            under: Vec::new(),
        }
    }

    /// Returns each divisor of either value with its power in both.
    fn powers(&self, other: &Degree) -> Vec<(Rc<f64>, f64, f64)> {
        let (mut own, mut others) = (self.under.iter().peekable(), other.under.iter().peekable());
        let address = |entry: Option<&&(Rc<f64>, f64)>| entry.map(|(d, _)| Rc::as_ptr(d).addr());
        let mut all = Vec::new();
        loop {
            let (a, b) = (address(own.peek()), address(others.peek()));
            let Some(least) = a.into_iter().chain(b).min() else {
                return all;
            };
            let a = own.next_if(|_| a == Some(least));
            let b = others.next_if(|_| b == Some(least));
            let power = |entry: Option<&(Rc<f64>, f64)>| entry.map_or(0.0, |(_, power)| *power);
            if let Some((divisor, _)) = a.or(b) {
                all.push((divisor.clone(), power(a), power(b)));
            }
        }
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
        Degree {
            top: a.max(b),
            under,
        }
    }
    fn sub(&self, other: &Self) -> Self {
        self.add(other)
    }
    fn mul(&self, other: &Self) -> Self {
        let powers = self.powers(other).into_iter();
        Degree {
            top: self.top + other.top,
            under: powers.map(|(d, a, b)| (d, a + b)).collect(),
        }
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
        for (divisor, own, others) in self.powers(other) {
            if others > own {
                top += (others - own) * *divisor;
            } else if own > others {
                under.push((divisor, own - others));
            }
        }
        if other.top > 0.0 {
            under.push((Rc::new(other.top), 1.0));
            under.sort_by_key(|(divisor, _)| Rc::as_ptr(divisor).addr());
        }
        Degree { top, under }
    }
}

/// Degrees of inputs and constants; collects the constant angles that are read.
#[derive(Debug, Default)]
pub(super) struct Degrees(RefCell<Vec<Angle>>);

impl Degrees {
    /// Returns a bound of the degree of the differences between two lists of values in the
    /// parameters that are drawn, for an arm of `joints` joints.
    pub(super) fn of_differences(
        &self,
        own: &[Sparse<Degree>],
        others: &[Sparse<Degree>],
        joints: usize,
    ) -> f64 {
        let differences = own.iter().zip(others).map(|(a, b)| a.add(b));
        let tops = differences.map(|value| value.value().map_or(f64::INFINITY, |x| x.top));
        let pairs = joints + self.0.borrow().len();
        // A sum of infinities of both signs is no number, and must not pass for a small one.
        let most = tops.fold(0.0, |most: f64, top| match top.is_nan() {
            true => f64::INFINITY,
            false => most.max(top),
        });
        (2 * pairs + 1) as f64 * most
    }
}

impl Leaves for Degrees {
    type Value = Sparse<Degree>;

    fn input(&self, _: Input) -> Sparse<Degree> {
        Sparse::Value(Degree::new(1.0))
    }

    fn constant(&self, constant: &Exact) -> Sparse<Degree> {
        let pair = &mut |angle: &Angle| {
            let mut known = self.0.borrow_mut();
            if !known.contains(angle) {
                known.push(angle.clone());
            }
            SinCosPair {
                sin: Degree::new(1.0),
                cos: Degree::new(1.0),
            }
        };
        let degree = constant.map(&mut |_| Some(Degree::new(0.0)), pair);
        Sparse::constant(constant, degree.unwrap_or_default())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// x/y + z/y has one y, x/y + z/w both; a divisor that is divided by again goes back up.
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

    /// Whatever grows beyond counting has an infinite degree.
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
