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

use super::exact::Disproof;
use crate::dag::Leaves;
use crate::program::Input;

/// The largest degree for which a miss is as unlikely as is said.
const MAX_DEGREE: f64 = (1u64 << 30) as f64;

/// The degree of a polynomial over powers of divisors; infinite beyond a double's range.
#[derive(Clone, Debug, Default)]
pub(super) struct Degree {
    top: f64,
    /// The degree of each divisor, which its address tells from others, and its power.
    under: Vec<(Rc<f64>, f64)>,
}

impl Degree {
    fn new(top: f64) -> Degree {
        Degree {
            top,
            under: Vec::new(),
        }
    }

    fn powers(&self, other: &Degree) -> Vec<(Rc<f64>, f64, f64)> {
        let own = self.under.iter().map(|(d, e)| (d.clone(), *e, 0.0));
        let others = other.under.iter().map(|(d, e)| (d.clone(), 0.0, *e));
        let mut all: Vec<_> = own.chain(others).collect();
        // Stable: of two of a divisor the own one is first.
        all.sort_by_key(|(divisor, ..)| Rc::as_ptr(divisor).addr());
        all.dedup_by(|second, first| {
            let is_same = Rc::ptr_eq(&second.0, &first.0);
            if is_same {
                first.2 = second.2;
            }
            is_same
        });
        all
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
        }
        Degree { top, under }
    }
}

#[derive(Debug, Default)]
pub(super) struct Degrees(RefCell<Vec<Angle>>);

impl Degrees {
    /// A large degree of a difference in the drawn parameters makes a miss too likely.
    pub(super) fn bound(
        &self,
        own: &[Sparse<Degree>],
        others: &[Sparse<Degree>],
        joints: usize,
    ) -> Result<(), Disproof> {
        let pairs = joints + self.0.borrow().len();
        // Infinities of both signs make no number, which is not small.
        let is_small = |degree: Degree| (2 * pairs + 1) as f64 * degree.top <= MAX_DEGREE;
        let mut differences = own.iter().zip(others).map(|(a, b)| a.add(b).value());
        match differences.all(|degree| degree.is_some_and(is_small)) {
            true => Ok(()),
            false => Err(Disproof::Large),
        }
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
