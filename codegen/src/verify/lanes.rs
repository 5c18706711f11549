//! Numbers of several states side by side: what a state's own arithmetic would give, in
//! loops that a compiler makes vectors of.

use std::array::from_fn;

use dalembert_model::scalar::{Divide, Scalar};

/// The number of states side by side.
pub(super) const LANES: usize = 8;

/// A number of each. What is zero stays zero, whatever it is multiplied by: an error
/// that does not arrive is none, however large what it would be multiplied with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Lanes(pub [f64; LANES]);

impl Lanes {
    /// Returns the same number in each lane.
    pub(super) fn all(value: f64) -> Lanes {
        Lanes([value; LANES])
    }

    pub(super) fn vanishes(&self) -> bool {
        self.0.iter().all(|x| *x == 0.0)
    }

    fn map(&self, f: impl Fn(f64) -> f64) -> Lanes {
        Lanes(self.0.map(f))
    }

    fn zip(&self, other: &Lanes, f: impl Fn(f64, f64) -> f64) -> Lanes {
        Lanes(from_fn(|k| f(self.0[k], other.0[k])))
    }

    /// Returns x²
    pub(super) fn square(&self) -> Lanes {
        self.map(|x| x * x)
    }

    /// Returns √x
    pub(super) fn sqrt(&self) -> Lanes {
        self.map(libm::sqrt)
    }
}

impl Scalar for Lanes {
    fn zero() -> Self {
        Lanes::all(0.0)
    }
    fn one() -> Self {
        Lanes::all(1.0)
    }
    fn add(&self, other: &Self) -> Self {
        self.zip(other, |x, y| x + y)
    }
    fn sub(&self, other: &Self) -> Self {
        self.zip(other, |x, y| x - y)
    }
    fn mul(&self, other: &Self) -> Self {
        self.zip(other, |x, y| match x == 0.0 || y == 0.0 {
            true => 0.0,
            false => x * y,
        })
    }
    fn neg(&self) -> Self {
        self.map(|x| -x)
    }
    fn half(&self) -> Self {
        self.map(|x| 0.5 * x)
    }
}

impl Divide for Lanes {
    fn div(&self, other: &Self) -> Self {
        self.zip(other, |x, y| match x == 0.0 {
            true => 0.0,
            false => x / y,
        })
    }
}
