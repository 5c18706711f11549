//! A value with its rate of change: the derivative of a formula from the same text as the formula.

use super::{Divide, Scalar};
use crate::scalar::SinCosPair;

/// x and ẋ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual<S> {
    /// x
    pub value: S,
    /// ẋ
    pub rate: S,
}

impl<S: Scalar> Dual<S> {
    /// Returns a number that does not change.
    pub fn constant(value: S) -> Self {
        let rate = S::zero();
        Dual { value, rate }
    }

    fn with(&self, other: &Self, operation: impl Fn(&S, &S) -> S) -> Self {
        let value = operation(&self.value, &other.value);
        let rate = operation(&self.rate, &other.rate);
        Dual { value, rate }
    }
}

impl<S: Scalar> SinCosPair<S> {
    /// Returns the pair of an angle that changes at a rate.
    pub fn turning(self, rate: &S) -> SinCosPair<Dual<S>> {
        let [sin_rate, cos_rate] = [self.cos.mul(rate), self.sin.mul(rate).neg()];
        let changing = |value, rate| Dual { value, rate };
        let (sin, cos) = (changing(self.sin, sin_rate), changing(self.cos, cos_rate));
        SinCosPair { sin, cos }
    }
}

impl<S: Scalar> Scalar for Dual<S> {
    fn zero() -> Self {
        Dual::constant(S::zero())
    }
    fn one() -> Self {
        Dual::constant(S::one())
    }
    fn add(&self, other: &Self) -> Self {
        self.with(other, S::add)
    }
    fn sub(&self, other: &Self) -> Self {
        self.with(other, S::sub)
    }
    fn mul(&self, other: &Self) -> Self {
        let [left, right] = [self.rate.mul(&other.value), self.value.mul(&other.rate)];
        let value = self.value.mul(&other.value);
        let rate = left.add(&right);
        Dual { value, rate }
    }
    fn neg(&self) -> Self {
        self.with(self, |x, _| x.neg())
    }
    fn half(&self) -> Self {
        self.with(self, |x, _| x.half())
    }
    fn is_zero(&self) -> bool {
        self.value.is_zero() && self.rate.is_zero()
    }
    fn is_one(&self) -> bool {
        self.value.is_one() && self.rate.is_zero()
    }
}

impl<S: Divide> Divide for Dual<S> {
    /// Returns (x/y)˙ = (ẋ − (x/y) ẏ)/y
    fn div(&self, other: &Self) -> Self {
        let value = self.value.div(&other.value);
        let rate = self.rate.sub(&value.mul(&other.rate)).div(&other.value);
        Dual { value, rate }
    }
}
