//! The arithmetic that every formula is generic over.
//!
//! A scalar never calls sin or cos: the equations take each joint's (sin, cos) pair as input. Zero
//! and one need no context, so that symbolic and counting scalars fold them without a state.
//!
//! - this file: floats, for the generic runtime, and the pair in which formulas take an angle
//! - [`field`]: integers modulo primes: in one the search compares values, in another proofs are made
//! - [`sparse`]: values of any scalar that know when they are zero or one by structure
//! - [`dual`]: a value with its rate of change, for derivatives
//! - [`structural`]: sums and products without structural zeros and ones
//! - [`count`]: counts the operations of a formula as written

pub mod count;
pub mod dual;
pub mod field;
pub mod sparse;
pub mod structural;

use structural::{minus, plus, times};

/// A commutative ring with a half, enough for every dynamics formula.
///
/// Methods take references: of a symbolic scalar, a shared handle, operators would hide clones.
pub trait Scalar: Clone {
    /// Returns the additive identity, known as such without context.
    fn zero() -> Self;
    /// Returns the multiplicative identity, known as such without context.
    fn one() -> Self;
    /// Returns `self + other`
    fn add(&self, other: &Self) -> Self;
    /// Returns `self − other`
    fn sub(&self, other: &Self) -> Self {
        self.add(&other.neg())
    }
    /// Returns `self · other`
    fn mul(&self, other: &Self) -> Self;
    /// Returns `−self`
    fn neg(&self) -> Self;
    /// Returns `self / 2`, exact in every scalar (floats: but for underflow).
    fn half(&self) -> Self;

    /// True if the value is zero *by structure*, whatever the state is.
    ///
    /// Floats answer `false` even for 0.0: skipping `0 · x` would lose a NaN
    /// or an infinity in `x`, and would put a branch into the runtime.
    fn is_zero(&self) -> bool {
        false
    }
    /// True if the value is one by structure.
    fn is_one(&self) -> bool {
        false
    }
    /// Returns `2 · self`, one addition.
    fn double(&self) -> Self {
        self.add(self)
    }
    /// Returns `self · factor + addend`; floats round it once.
    fn mul_add(&self, factor: &Self, addend: &Self) -> Self {
        self.mul(factor).add(addend)
    }
}

/// A scalar with quotients: what programs run in.
///
/// A formula may divide only by what cannot vanish wherever it is meant to hold, and says why.
/// Where a divisor is zero all the same there is no quotient, and no scalar panics: floats return
/// an infinity or NaN, the field returns zero, and [`sparse`] residues are lost.
pub trait Divide: Scalar {
    /// Returns `self / other`
    fn div(&self, other: &Self) -> Self;

    /// Returns `false` for a divisor that gives no quotient.
    fn divides(&self) -> bool {
        true
    }
}

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
        let sin = plus(&times(&self.sin, &other.cos), &times(&self.cos, &other.sin));
        let cos = minus(&times(&self.cos, &other.cos), &times(&self.sin, &other.sin));
        SinCosPair { sin, cos }
    }
}

impl<S> SinCosPair<S> {
    /// Returns both entries through `f`.
    pub fn map<T>(&self, mut f: impl FnMut(&S) -> T) -> SinCosPair<T> {
        let (sin, cos) = (f(&self.sin), f(&self.cos));
        SinCosPair { sin, cos }
    }
}

macro_rules! float_scalar {
    ($t:ty, $mul_add:path) => {
        impl Scalar for $t {
            fn zero() -> Self {
                0.0
            }
            fn one() -> Self {
                1.0
            }
            #[inline]
            fn add(&self, other: &Self) -> Self {
                self + other
            }
            #[inline]
            fn sub(&self, other: &Self) -> Self {
                self - other
            }
            #[inline]
            fn mul(&self, other: &Self) -> Self {
                self * other
            }
            #[inline]
            fn neg(&self) -> Self {
                -*self
            }
            fn half(&self) -> Self {
                0.5 * self
            }
            // `core` has no fused operation.
            fn mul_add(&self, factor: &Self, addend: &Self) -> Self {
                $mul_add(*self, *factor, *addend)
            }
        }

        impl Divide for $t {
            #[inline]
            fn div(&self, other: &Self) -> Self {
                self / other
            }
        }
    };
}
float_scalar!(f32, libm::fmaf);
float_scalar!(f64, libm::fma);
