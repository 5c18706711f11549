//! One number or several at once: an operation on each, which compilers turn
//! into one on a vector. Loops over arrays whose length is known: they are short
//! enough to be unrolled.

use core::ops::{Add, Mul, Sub};

/// A float, or one for each lane; the other operand may be one for all.
pub trait Number<T>:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Add<T, Output = Self>
    + Sub<T, Output = Self>
    + Mul<T, Output = Self>
{
    /// The same in every lane.
    fn all(value: T) -> Self;
}

impl Number<f64> for f64 {
    #[inline(always)]
    fn all(value: f64) -> f64 {
        value
    }
}

impl Number<f32> for f32 {
    #[inline(always)]
    fn all(value: f32) -> f32 {
        value
    }
}

impl<T> Number<T> for Lanes<T>
where
    T: Copy + Add<Output = T> + Sub<Output = T> + Mul<Output = T>,
{
    #[inline(always)]
    fn all(value: T) -> Self {
        Lanes([value; LANES])
    }
}

/// So many angles are computed at once: one vector of AVX-512 in f64, two of
/// SSE in f32.
pub const LANES: usize = 8;

/// A number for each lane.
#[derive(Clone, Copy)]
pub struct Lanes<T>(pub [T; LANES]);

macro_rules! operation {
    ($operation:ident, $method:ident, $symbol:tt) => {
        impl<T: Copy + $operation<Output = T>> $operation for Lanes<T> {
            type Output = Self;
            #[inline(always)]
            fn $method(mut self, other: Self) -> Self {
                let mut lane = 0;
                while lane < LANES {
                    self.0[lane] = self.0[lane] $symbol other.0[lane];
                    lane += 1;
                }
                self
            }
        }

        impl<T: Copy + $operation<Output = T>> $operation<T> for Lanes<T> {
            type Output = Self;
            #[inline(always)]
            fn $method(mut self, other: T) -> Self {
                let mut lane = 0;
                while lane < LANES {
                    self.0[lane] = self.0[lane] $symbol other;
                    lane += 1;
                }
                self
            }
        }
    };
}
operation!(Add, add, +);
operation!(Sub, sub, -);
operation!(Mul, mul, *);
