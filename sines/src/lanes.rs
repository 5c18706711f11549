//! Several numbers at once: an operation on each, which compilers turn into
//! one on a vector.
//!
//! Plain loops over arrays whose length is known: they are short enough for
//! every compiler to unroll, and cost little where nothing is optimised.

use core::ops::{Add, Mul, Sub};

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
