//! The operations that the computation needs of a number, and of several at once.

use core::num::Wrapping;
use core::ops::{Add, BitAnd, BitXor, Mul, Sub};

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
    /// Returns the same number in every lane.
    fn all(value: T) -> Self;
}

/// Floats of known bits: one, or a vector of them.
pub trait Floats<T>: Number<T> {
    /// Their bits, as integers that wrap.
    type Bits: Copy
        + BitXor<Output = Self::Bits>
        + BitAnd<Output = Self::Bits>
        + Add<Output = Self::Bits>
        + Sub<Output = Self::Bits>;

    fn bits(self) -> Self::Bits;
    fn of_bits(bits: Self::Bits) -> Self;
    /// Powers of two in every lane; of the exponent that the sign's bit has,
    /// the sign's.
    fn power(exponent: usize) -> Self::Bits;
    fn shifted(bits: Self::Bits, by: usize) -> Self::Bits;
    /// Returns whether every lane is at most `largest` in magnitude, and a number.
    fn are_within(self, largest: T) -> bool;
}

macro_rules! scalar {
    ($float:ident, $bits:ident) => {
        impl Number<$float> for $float {
            #[inline(always)]
            fn all(value: $float) -> $float {
                value
            }
        }

        impl Floats<$float> for $float {
            type Bits = Wrapping<$bits>;

            #[inline(always)]
            fn bits(self) -> Self::Bits {
                Wrapping(self.to_bits())
            }

            #[inline(always)]
            fn of_bits(bits: Self::Bits) -> $float {
                $float::from_bits(bits.0)
            }

            #[inline(always)]
            fn power(exponent: usize) -> Self::Bits {
                Wrapping(1 << exponent)
            }

            #[inline(always)]
            fn shifted(bits: Self::Bits, by: usize) -> Self::Bits {
                bits << by
            }

            #[inline(always)]
            fn are_within(self, largest: $float) -> bool {
                self.abs() <= largest
            }
        }
    };
}
scalar!(f64, u64);
scalar!(f32, u32);
