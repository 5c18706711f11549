//! Numbers of several states side by side: what a state's own arithmetic would give, in
//! loops that a compiler makes vectors of.

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

    // Plain loops, inlined: compilers make calls of arrays' own `map` and `from_fn` here.
    #[inline(always)]
    fn map(mut self, f: impl Fn(f64) -> f64) -> Lanes {
        for x in &mut self.0 {
            *x = f(*x);
        }
        self
    }

    #[inline(always)]
    fn zip(mut self, other: &Lanes, f: impl Fn(f64, f64) -> f64) -> Lanes {
        for (x, y) in self.0.iter_mut().zip(&other.0) {
            *x = f(*x, *y);
        }
        self
    }

    /// Returns x²
    #[inline]
    pub(super) fn square(&self) -> Lanes {
        self.map(|x| x * x)
    }

    /// Returns √x
    #[inline]
    pub(super) fn sqrt(&self) -> Lanes {
        self.map(libm::sqrt)
    }
}

impl Scalar for Lanes {
    #[inline]
    fn zero() -> Self {
        Lanes::all(0.0)
    }
    #[inline]
    fn one() -> Self {
        Lanes::all(1.0)
    }
    #[inline]
    fn add(&self, other: &Self) -> Self {
        self.zip(other, |x, y| x + y)
    }
    #[inline]
    fn sub(&self, other: &Self) -> Self {
        self.zip(other, |x, y| x - y)
    }
    #[inline]
    fn mul(&self, other: &Self) -> Self {
        self.zip(other, |x, y| match x == 0.0 || y == 0.0 {
            true => 0.0,
            false => x * y,
        })
    }
    #[inline]
    fn neg(&self) -> Self {
        self.map(|x| -x)
    }
    #[inline]
    fn half(&self) -> Self {
        self.map(|x| 0.5 * x)
    }
    #[inline]
    fn is_zero(&self) -> bool {
        self.0.iter().all(|x| *x == 0.0)
    }
}

impl Divide for Lanes {
    #[inline]
    fn div(&self, other: &Self) -> Self {
        self.zip(other, |x, y| match x == 0.0 {
            true => 0.0,
            false => x / y,
        })
    }
}
