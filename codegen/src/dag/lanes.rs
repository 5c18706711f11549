//! Numbers of several states, or of several points, side by side, with the bits that each has
//! alone, in loops that a compiler makes vectors of.

use dalembert_model::scalar::{Divide, Scalar};

pub(crate) const LANES: usize = 16;

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Lanes<T, const N: usize = LANES>(pub [T; N]);

impl<T: Divide + Copy, const N: usize> Lanes<T, N> {
    /// The lanes beyond `values` repeat the last of them.
    pub(crate) fn new(values: &[T]) -> Option<Self> {
        let last = *values.last()?;
        let lane = |lane: usize| values.get(lane).copied().unwrap_or(last);
        Some(Lanes(core::array::from_fn(lane)))
    }

    // Plain loops, inlined: compilers make calls of arrays' own `map` and `from_fn` here.
    #[inline(always)]
    fn zip(mut self, other: &Self, f: impl Fn(&T, &T) -> T) -> Self {
        for (x, y) in self.0.iter_mut().zip(&other.0) {
            *x = f(x, y);
        }
        self
    }
}

impl<T: Divide + Copy, const N: usize> Scalar for Lanes<T, N> {
    fn zero() -> Self {
        Lanes([T::zero(); N])
    }
    fn one() -> Self {
        Lanes([T::one(); N])
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
    #[inline]
    fn neg(&self) -> Self {
        self.zip(self, |x, _| x.neg())
    }
    fn half(&self) -> Self {
        self.zip(self, |x, _| x.half())
    }
    fn is_zero(&self) -> bool {
        self.0.iter().all(T::is_zero)
    }
    fn mul_add(&self, factor: &Self, addend: &Self) -> Self {
        let mut lanes = *self;
        for ((x, factor), addend) in lanes.0.iter_mut().zip(&factor.0).zip(&addend.0) {
            *x = x.mul_add(factor, addend);
        }
        lanes
    }
}

impl<T: Divide + Copy, const N: usize> Divide for Lanes<T, N> {
    #[inline]
    fn div(&self, other: &Self) -> Self {
        self.zip(other, T::div)
    }
}
