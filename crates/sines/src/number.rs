//! The operations that the computation needs of a number, and of several at once.

use core::num::Wrapping;
use core::ops::{Add, BitAnd, BitXor, Div, Mul, Neg, Sub};

/// A float, or one for each lane.
pub trait Number<T>:
    Copy + Neg<Output = Self> + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self>
{
    /// Returns a value in every lane that this number has.
    fn all(self, value: T) -> Self;

    /// Returns the product plus the addend, rounded once.
    #[must_use]
    fn fused(self, factor: Self, addend: Self) -> Self;
}

/// Takes products into sums, rounded before or fused with them.
pub trait Products<T> {
    /// A product of two such numbers.
    type Of<V: Number<T>>: Copy;

    /// Returns left·right
    fn of<V: Number<T>>(left: V, right: V) -> Self::Of<V>;
    /// Returns product + addend
    fn plus<V: Number<T>>(product: Self::Of<V>, addend: V) -> V;
    /// Returns product − number
    fn less<V: Number<T>>(product: Self::Of<V>, number: V) -> V;
    /// Returns number + product
    fn added<V: Number<T>>(number: V, product: Self::Of<V>) -> V;
    /// Returns number − product
    fn taken<V: Number<T>>(number: V, product: Self::Of<V>) -> V;
}

/// A product is rounded, and so is each sum of it.
#[derive(Clone, Copy, Debug)]
pub struct Rounded;

impl<T> Products<T> for Rounded {
    type Of<V: Number<T>> = V;

    #[inline(always)]
    fn of<V: Number<T>>(left: V, right: V) -> V {
        left * right
    }
    #[inline(always)]
    fn plus<V: Number<T>>(product: V, addend: V) -> V {
        product + addend
    }
    #[inline(always)]
    fn less<V: Number<T>>(product: V, number: V) -> V {
        product - number
    }
    #[inline(always)]
    fn added<V: Number<T>>(number: V, product: V) -> V {
        number + product
    }
    #[inline(always)]
    fn taken<V: Number<T>>(number: V, product: V) -> V {
        number - product
    }
}

/// A product is fused with each sum of it, which rounds once.
#[derive(Clone, Copy, Debug)]
pub struct Fused;

impl<T> Products<T> for Fused {
    type Of<V: Number<T>> = (V, V);

    #[inline(always)]
    fn of<V: Number<T>>(left: V, right: V) -> (V, V) {
        (left, right)
    }
    #[inline(always)]
    fn plus<V: Number<T>>((left, right): (V, V), addend: V) -> V {
        left.fused(right, addend)
    }
    #[inline(always)]
    fn less<V: Number<T>>((left, right): (V, V), number: V) -> V {
        left.fused(right, -number)
    }
    #[inline(always)]
    fn added<V: Number<T>>(number: V, (left, right): (V, V)) -> V {
        left.fused(right, number)
    }
    #[inline(always)]
    fn taken<V: Number<T>>(number: V, (left, right): (V, V)) -> V {
        (-left).fused(right, number)
    }
}

/// Floats of known bits, one or a vector; the other operand may be one float for all.
pub trait Floats<T>:
    Number<T>
    + Div<Output = Self>
    + Add<T, Output = Self>
    + Sub<T, Output = Self>
    + Mul<T, Output = Self>
{
    /// Their bits, as integers that wrap.
    type Bits: Copy
        + BitXor<Output = Self::Bits>
        + BitAnd<Output = Self::Bits>
        + Add<Output = Self::Bits>
        + Sub<Output = Self::Bits>;

    fn bits(self) -> Self::Bits;
    fn of_bits(bits: Self::Bits) -> Self;
    /// Returns a power of two in every lane; of the exponent that the sign's bit has, that bit.
    fn power(self, exponent: usize) -> Self::Bits;
    /// Shifts the last two bits of every lane to its first two places.
    fn raised(bits: Self::Bits) -> Self::Bits;
    /// True if every lane is at most `largest` in magnitude, and a number.
    fn are_within(self, largest: T) -> bool;
}

macro_rules! scalar {
    ($float:ident, $bits:ident, $fma:ident) => {
        impl Number<$float> for $float {
            #[inline(always)]
            fn all(self, value: $float) -> $float {
                value
            }
            #[inline(always)]
            fn fused(self, factor: $float, addend: $float) -> $float {
                libm::$fma(self, factor, addend)
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
            fn power(self, exponent: usize) -> Self::Bits {
                Wrapping(1 << exponent)
            }
            #[inline(always)]
            fn raised(bits: Self::Bits) -> Self::Bits {
                bits << ($bits::BITS as usize - 2)
            }
            #[inline(always)]
            fn are_within(self, largest: $float) -> bool {
                self.abs() <= largest
            }
        }
    };
}
scalar!(f64, u64, fma);
scalar!(f32, u32, fmaf);

/// Two numbers side by side: each operation is done with both, so that neither waits for itself.
#[derive(Clone, Copy)]
pub struct Pair<V>(pub V, pub V);

macro_rules! pairwise {
    ($($operation:ident, $method:ident);*) => {$(
        impl<V: $operation<Output = V>> $operation for Pair<V> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Pair(self.0.$method(other.0), self.1.$method(other.1))
            }
        }
    )*};
}
pairwise!(Add, add; Sub, sub; Mul, mul);

impl<V: Neg<Output = V>> Neg for Pair<V> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Pair(-self.0, -self.1)
    }
}

impl<T: Copy, V: Number<T>> Number<T> for Pair<V> {
    #[inline(always)]
    fn all(self, value: T) -> Self {
        Pair(self.0.all(value), self.1.all(value))
    }
    #[inline(always)]
    fn fused(self, factor: Self, addend: Self) -> Self {
        let first = self.0.fused(factor.0, addend.0);
        Pair(first, self.1.fused(factor.1, addend.1))
    }
}
