//! Numbers of several states side by side, with the bits that each has alone, in loops that a
//! compiler makes vectors of.

use dalembert_model::scalar::{Divide, Scalar};

/// The number of states side by side.
pub(crate) const LANES: usize = 16;

/// A number of each.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Lanes<T>(pub [T; LANES]);

impl<T: Divide + Copy> Lanes<T> {
    /// Returns lanes of these numbers; those beyond repeat the last of them. None of no number.
    pub(crate) fn new(values: &[T]) -> Option<Lanes<T>> {
        let last = *values.last()?;
        let lane = |lane: usize| values.get(lane).copied().unwrap_or(last);
        Some(Lanes(core::array::from_fn(lane)))
    }

    // Plain loops, inlined: compilers make calls of arrays' own `map` and `from_fn` here.
    #[inline(always)]
    fn zip(mut self, other: &Lanes<T>, f: impl Fn(&T, &T) -> T) -> Self {
        for (x, y) in self.0.iter_mut().zip(&other.0) {
            *x = f(x, y);
        }
        self
    }
}

impl<T: Divide + Copy> Scalar for Lanes<T> {
    fn zero() -> Self {
        Lanes([T::zero(); LANES])
    }

    fn one() -> Self {
        Lanes([T::one(); LANES])
    }

    #[inline]
    fn add(&self, other: &Self) -> Self {
        self.zip(other, T::add)
    }

    #[inline]
    fn sub(&self, other: &Self) -> Self {
        self.zip(other, T::sub)
    }

    #[inline]
    fn mul(&self, other: &Self) -> Self {
        self.zip(other, T::mul)
    }

    fn neg(&self) -> Self {
        self.zip(self, |x, _| x.neg())
    }

    fn half(&self) -> Self {
        self.zip(self, |x, _| x.half())
    }

    /// Returns whether all are zero by structure.
    fn is_zero(&self) -> bool {
        self.0.iter().all(T::is_zero)
    }

    fn mul_add(&self, factor: &Self, addend: &Self) -> Self {
        let mut all = *self;
        for ((x, factor), addend) in all.0.iter_mut().zip(&factor.0).zip(&addend.0) {
            *x = x.mul_add(factor, addend);
        }
        all
    }
}

impl<T: Divide + Copy> Divide for Lanes<T> {
    #[inline]
    fn div(&self, other: &Self) -> Self {
        self.zip(other, T::div)
    }
}
