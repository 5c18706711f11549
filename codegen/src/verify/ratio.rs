//! Degrees of what divides: polynomials times powers of the divisors.
//!
//! A quotient is a rational function. Its divisor, with what it is divided by
//! itself taken out, is a polynomial, and becomes a factor d with a negative
//! power; a divisor that is used again is the same factor. Two such functions
//! differ by
//!
//! ```text
//! N Π dᵉ − M Π dᶠ = Π d^min(e, f) (N Π d^(e − min) − M Π d^(f − min))
//! ```
//!
//! and where no divisor vanishes that is zero with the polynomial in brackets.
//! At a point where one does there is no quotient: the point is unfit, and
//! another is drawn.

use std::rc::Rc;

use dalembert_model::number::Exact;
use dalembert_model::scalar::{Divide, Scalar};

use super::degree::Degree;
use super::size::Denominators;
use crate::program::{Input, Program};

/// A polynomial times powers of divisors.
#[derive(Clone, Debug)]
pub struct Ratio {
    /// None if its degree is beyond counting.
    top: Option<Degree>,
    powers: Vec<(Rc<Degree>, i64)>,
}

impl From<Degree> for Ratio {
    fn from(top: Degree) -> Ratio {
        Ratio {
            top: Some(top),
            powers: Vec::new(),
        }
    }
}

impl Ratio {
    /// Returns the ratio of an input.
    pub fn input(input: Input) -> Ratio {
        Degree::input(input).into()
    }

    /// Returns the ratio of a constant and adds its denominators to `denominators`.
    pub fn constant(constant: &Exact, denominators: &mut Denominators) -> Ratio {
        Degree::constant(constant, denominators).into()
    }

    /// Returns the polynomial that vanishes with it; none if its degree is beyond
    /// counting.
    pub fn top(&self) -> Option<&Degree> {
        self.top.as_ref()
    }

    fn unknown() -> Ratio {
        Ratio {
            top: None,
            powers: Vec::new(),
        }
    }

    fn power(&self, divisor: &Rc<Degree>) -> i64 {
        let mut powers = self.powers.iter();
        let found = powers.find(|(own, _)| Rc::ptr_eq(own, divisor));
        found.map_or(0, |(_, power)| *power)
    }

    /// Returns the divisors of both, each once.
    fn divisors(&self, other: &Ratio) -> Vec<Rc<Degree>> {
        let mut all: Vec<Rc<Degree>> = Vec::new();
        for (divisor, _) in self.powers.iter().chain(&other.powers) {
            if !all.iter().any(|known| Rc::ptr_eq(known, divisor)) {
                all.push(divisor.clone());
            }
        }
        all
    }

    /// Returns the polynomial by divisors raised to what is left of their powers
    /// above these.
    fn above(&self, least: &[(Rc<Degree>, i64)]) -> Option<Degree> {
        let mut top = self.top.clone()?;
        for (divisor, power) in least {
            let rest = self.power(divisor).checked_sub(*power)?;
            top = top.mul(&raised(divisor, rest.try_into().ok()?));
        }
        Some(top)
    }

    /// Powers of the divisors of both.
    fn combined(
        &self,
        other: &Ratio,
        power: impl Fn(i64, i64) -> Option<i64>,
    ) -> Option<Vec<(Rc<Degree>, i64)>> {
        let both = self.divisors(other).into_iter().map(|divisor| {
            let power = power(self.power(&divisor), other.power(&divisor))?;
            Some((divisor, power))
        });
        both.collect()
    }
}

/// Returns dᵏ
fn raised(degree: &Degree, mut exponent: u64) -> Degree {
    let (mut power, mut square) = (Degree::one(), degree.clone());
    while exponent > 0 {
        if exponent & 1 == 1 {
            power = power.mul(&square);
        }
        square = square.mul(&square);
        exponent >>= 1;
    }
    power
}

impl Scalar for Ratio {
    fn zero() -> Self {
        Degree::zero().into()
    }
    fn one() -> Self {
        Degree::one().into()
    }
    fn add(&self, other: &Self) -> Self {
        match (self.is_zero(), other.is_zero()) {
            (true, _) => return other.clone(),
            (_, true) => return self.clone(),
            _ => {}
        }
        let Some(least) = self.combined(other, |a, b| Some(a.min(b))) else {
            return Ratio::unknown();
        };
        let top = self.above(&least).zip(other.above(&least));
        Ratio {
            top: top.map(|(a, b)| a.add(&b)),
            powers: least,
        }
    }
    fn sub(&self, other: &Self) -> Self {
        self.add(other)
    }
    fn mul(&self, other: &Self) -> Self {
        if self.is_zero() || other.is_zero() {
            return Ratio::zero();
        }
        let top = self.top.as_ref().zip(other.top.as_ref());
        match (top, self.combined(other, i64::checked_add)) {
            (Some((a, b)), Some(powers)) => Ratio {
                top: Some(a.mul(b)),
                powers,
            },
            _ => Ratio::unknown(),
        }
    }
    fn neg(&self) -> Self {
        self.clone()
    }
    fn half(&self) -> Self {
        Ratio {
            top: self.top.as_ref().map(Degree::half),
            powers: self.powers.clone(),
        }
    }
    fn is_zero(&self) -> bool {
        self.top.as_ref().is_some_and(Degree::is_zero)
    }
}

impl Divide for Ratio {
    fn div(&self, other: &Self) -> Self {
        let inverse = other.powers.iter().map(|(divisor, power)| {
            let power = power.checked_neg()?;
            Some((divisor.clone(), power))
        });
        let inverse: Option<Vec<_>> = inverse.collect();
        match (&other.top, inverse) {
            (Some(divisor), Some(mut powers)) => {
                powers.push((Rc::new(divisor.clone()), -1));
                self.mul(&Ratio {
                    top: Some(Degree::one()),
                    powers,
                })
            }
            _ => Ratio::unknown(),
        }
    }
}

impl Program {
    /// Returns the degrees of every output; the denominators of its constants are
    /// noted.
    pub fn degrees(&self, denominators: &mut Denominators) -> Vec<Ratio> {
        let constant = |constant: &Exact| Some(Ratio::constant(constant, denominators));
        let degrees = self.evaluate(|input| Some(Ratio::input(*input)), constant);
        degrees.unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::function::Argument;

    fn variable(joint: usize) -> Ratio {
        Ratio::input(Input::Entry(Argument::Velocity, joint))
    }

    fn degree(ratio: &Ratio) -> u64 {
        ratio.top().map_or(u64::MAX, Degree::bound)
    }

    /// x/y + z/y has one y, x/y + z/w both; what a quotient is multiplied by
    /// again is gone.
    #[test]
    fn a_divisor_counts_once() {
        let [x, y, z, w] = [0, 1, 2, 3].map(variable);
        let inverse = Ratio::one().div(&y);
        assert_eq!(degree(&x.mul(&inverse).add(&z.mul(&inverse))), 1);
        assert_eq!(degree(&x.mul(&inverse).add(&z.div(&w))), 2);
        assert_eq!(degree(&x.mul(&inverse).add(&z)), 2);
        // 1/(x/y + z) is y/(x + z y), and with one more (y + x + z y)/(x + z y).
        let nested = Ratio::one().div(&x.mul(&inverse).add(&z));
        assert_eq!(degree(&nested), 0);
        assert_eq!(degree(&nested.add(&Ratio::one())), 2);
    }

    /// Whatever grows beyond counting has no degree, rather than a small one.
    #[test]
    fn powers_without_end_have_no_degree() {
        let mut power = Ratio::one().div(&variable(0));
        for _ in 0..80 {
            power = power.mul(&power);
        }
        assert_eq!(degree(&power.add(&Ratio::one())), u64::MAX);
    }
}
