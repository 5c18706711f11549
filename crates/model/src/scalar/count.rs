//! Counts the operations of a formula as it is written.

use core::cell::Cell;

use super::Scalar;

/// A counter of the operations of one evaluation.
#[derive(Debug, Default)]
pub struct Counter {
    multiplications: Cell<u64>,
    additions: Cell<u64>,
}

impl Counter {
    /// Returns nothing counted yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Returns a value that nothing is known about, whose operations count here.
    pub fn value(&self) -> Count<'_> {
        Count::Value(self)
    }

    /// Returns the multiplications, with halvings, and the additions, with differences and doublings.
    pub fn counts(&self) -> (u64, u64) {
        (self.multiplications.get(), self.additions.get())
    }
}

/// A value that knows whether it is 0, ±1, another number or depends on the
/// state. Operations between numbers are free: they are done once, beforehand.
#[derive(Clone, Copy, Debug)]
pub enum Count<'a> {
    /// 0
    Zero,
    /// 1
    One,
    /// −1
    MinusOne,
    /// Another number.
    Number,
    /// Not known beforehand.
    Value(&'a Counter),
}

use Count::{MinusOne, Number, One, Value, Zero};

impl Scalar for Count<'_> {
    fn zero() -> Self {
        Zero
    }
    fn one() -> Self {
        One
    }
    fn add(&self, other: &Self) -> Self {
        match (self, other) {
            (Zero, x) | (x, Zero) => *x,
            (One, MinusOne) | (MinusOne, One) => Zero,
            (Value(counter), _) | (_, Value(counter)) => {
                counter.additions.update(|count| count + 1);
                Value(counter)
            }
            (One | MinusOne | Number, One | MinusOne | Number) => Number,
        }
    }
    fn mul(&self, other: &Self) -> Self {
        match (self, other) {
            (Zero, _) | (_, Zero) => Zero,
            (One, x) | (x, One) => *x,
            (MinusOne, x) | (x, MinusOne) => x.neg(),
            (Value(counter), _) | (_, Value(counter)) => {
                counter.multiplications.update(|count| count + 1);
                Value(counter)
            }
            (Number, Number) => Number,
        }
    }
    fn neg(&self) -> Self {
        match self {
            One => MinusOne,
            MinusOne => One,
            x => *x,
        }
    }
    fn half(&self) -> Self {
        match self {
            One | MinusOne => Number,
            x => x.mul(&Number),
        }
    }
    fn is_zero(&self) -> bool {
        matches!(self, Zero)
    }
    fn is_one(&self) -> bool {
        matches!(self, One)
    }
}
