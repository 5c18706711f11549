//! The pair in which every formula takes an angle.

use super::Scalar;
use super::structural::{minus, plus, times};

/// Sine and cosine of one angle.
#[derive(Clone, Debug)]
pub struct SinCosPair<S> {
    /// sin
    pub sin: S,
    /// cos
    pub cos: S,
}

impl<S: Scalar> SinCosPair<S> {
    /// Returns the pair of the sum of two angles.
    pub fn compose(&self, other: &Self) -> Self {
        SinCosPair {
            sin: plus(&times(&self.sin, &other.cos), &times(&self.cos, &other.sin)),
            cos: minus(&times(&self.cos, &other.cos), &times(&self.sin, &other.sin)),
        }
    }
}

impl<S> SinCosPair<S> {
    /// Returns both entries through `f`.
    pub fn map<T>(&self, mut f: impl FnMut(&S) -> T) -> SinCosPair<T> {
        SinCosPair {
            sin: f(&self.sin),
            cos: f(&self.cos),
        }
    }
}
