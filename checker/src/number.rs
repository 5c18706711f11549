//! The numbers of the recursion: polynomials for bounds, doubles to look for states.

use crate::fault::Fault;

/// The most products of terms for all polynomials of one certificate, and of doubles in the search
/// of witnesses for all of its outputs.
pub const MOST_WORK: u64 = 400_000_000;

/// Counts products of terms, so that the work for one certificate is bounded.
#[derive(Debug, Default)]
pub struct Work(u64);

impl Work {
    pub(crate) fn spend(&mut self, products: usize) -> Result<(), Fault> {
        self.0 = self.0.saturating_add(products as u64);
        (self.0 <= MOST_WORK).then_some(()).ok_or(Fault::Work)
    }
}

/// A number of the robot file: within `radius` of a double.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Real {
    /// The nearest double.
    pub value: f64,
    /// The largest distance of the number from it.
    pub radius: f64,
}

impl From<f64> for Real {
    fn from(value: f64) -> Real {
        Real { value, radius: 0.0 }
    }
}

/// A commutative ring with the numbers of a robot file in it. The default is zero.
pub trait Number: Clone + Default {
    /// Returns a number of the robot file.
    fn constant(real: Real) -> Self;

    /// Returns the sum of two.
    #[must_use]
    fn plus(&self, other: &Self) -> Self;

    /// Returns the opposite.
    #[must_use]
    fn negated(&self) -> Self;

    /// Returns the product of two.
    ///
    /// # Errors
    /// More than is written out, or more work than is done.
    fn times(&self, other: &Self, work: &mut Work) -> Result<Self, Fault>;

    /// Returns one.
    fn one() -> Self {
        Self::constant(1.0.into())
    }
}

/// Rounded, and without a bound of that.
impl Number for f64 {
    fn constant(real: Real) -> f64 {
        real.value
    }

    fn plus(&self, other: &f64) -> f64 {
        self + other
    }

    fn negated(&self) -> f64 {
        -self
    }

    fn times(&self, other: &f64, work: &mut Work) -> Result<f64, Fault> {
        work.spend(1).map(|()| self * other)
    }
}

/// A number, and its slope where the state moves.
#[derive(Clone, Debug, Default)]
pub struct Dual<N> {
    /// The number.
    pub value: N,
    /// Its slope.
    pub slope: N,
}

impl<N: Number> Number for Dual<N> {
    fn constant(real: Real) -> Dual<N> {
        let (value, slope) = (N::constant(real), N::default());
        Dual { value, slope }
    }

    fn plus(&self, other: &Dual<N>) -> Dual<N> {
        Dual {
            value: self.value.plus(&other.value),
            slope: self.slope.plus(&other.slope),
        }
    }

    fn negated(&self) -> Dual<N> {
        Dual {
            value: self.value.negated(),
            slope: self.slope.negated(),
        }
    }

    fn times(&self, other: &Dual<N>, work: &mut Work) -> Result<Dual<N>, Fault> {
        let (own, others) = (
            self.slope.times(&other.value, work)?,
            self.value.times(&other.slope, work)?,
        );
        Ok(Dual {
            value: self.value.times(&other.value, work)?,
            slope: own.plus(&others),
        })
    }
}
