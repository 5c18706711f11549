//! Several angles in a vector of the processor: two or four doubles, four or eight
//! floats. Where it has none that wide, `wide` takes two for one, and bits stay.
//!
//! Not eight doubles: with vectors of 512 bits, processors have fewer units left for
//! the scalar arithmetic around them (an UR10's torques took 81 ns for 43).

use core::ops::{Add, Div, Mul, Neg, Sub};

use wide::bytemuck::cast;
use wide::{f32x4, f32x8, f64x2, f64x4, u32x4, u32x8, u64x2, u64x4};

use crate::angle::{Angle, rest, singly, turned, unusual};
use crate::number::{Floats, Number, Rounded};

pub trait Vectored: Angle {
    /// For one or two angles, or of f32 up to four.
    type Narrow: Vector<Self>;
    type Wide: Vector<Self>;
}

impl Vectored for f64 {
    type Narrow = TwoDoubles;
    type Wide = FourDoubles;
}

impl Vectored for f32 {
    type Narrow = FourFloats;
    type Wide = EightFloats;
}

/// Sines and cosines of any number of angles: in vectors where the processor has some and code is
/// optimised, so that angles and sines go in and out where they are computed; else by a call.
#[inline(always)]
pub(crate) fn all<T: Vectored, const N: usize>(angles: &[T; N]) -> ([T; N], [T; N]) {
    const VECTORS: bool = cfg!(any(
        target_feature = "sse2",
        target_feature = "neon",
        target_feature = "simd128"
    ));
    match VECTORS && !cfg!(debug_assertions) {
        true => together(angles),
        false => singly(angles),
    }
}

/// The last few angles go into a narrow vector if that has room.
#[inline(always)]
pub(crate) fn together<T: Vectored, const N: usize>(angles: &[T; N]) -> ([T; N], [T; N]) {
    let (mut sines, mut cosines) = ([T::default(); N], [T::default(); N]);
    let mut usual = true;
    let mut start = 0;
    while start + T::Narrow::LANES < N {
        usual &= T::Wide::sincos(angles, &mut sines, &mut cosines, start);
        start += T::Wide::LANES;
    }
    if start < N {
        usual &= T::Narrow::sincos(angles, &mut sines, &mut cosines, start);
    }
    if !usual {
        unusual(angles, &mut sines, &mut cosines);
    }
    (sines, cosines)
}

pub trait Vector<T: Angle>: Floats<T> {
    const LANES: usize;

    /// Computes sines and cosines of `LANES` angles from `start` on; returns true if all of them
    /// are in the polynomials' range. Past the end the last angle is repeated: of zeros, compilers
    /// would leave out the vector.
    fn sincos<const N: usize>(
        angles: &[T; N],
        sines: &mut [T; N],
        cosines: &mut [T; N],
        start: usize,
    ) -> bool;
}

macro_rules! operation {
    ($vector:ident, $wide:ident, $float:ident, $operation:ident, $method:ident, $symbol:tt) => {
        impl $operation for $vector {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                $vector(self.0 $symbol other.0)
            }
        }

        impl $operation<$float> for $vector {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: $float) -> Self {
                $vector(self.0 $symbol $wide::splat(other))
            }
        }
    };
}

macro_rules! vector {
    ($vector:ident, $wide:ident, $bits:ident, $float:ident, $lanes:literal) => {
        #[doc = concat!("`", stringify!($wide), "`, with what the computation asks of it.")]
        #[derive(Clone, Copy)]
        pub struct $vector($wide);

        operation!($vector, $wide, $float, Add, add, +);
        operation!($vector, $wide, $float, Sub, sub, -);
        operation!($vector, $wide, $float, Mul, mul, *);
        operation!($vector, $wide, $float, Div, div, /);

        impl Neg for $vector {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                $vector(-self.0)
            }
        }

        impl Number<$float> for $vector {
            #[inline(always)]
            fn all(self, value: $float) -> Self {
                $vector($wide::splat(value))
            }

            #[inline(always)]
            fn fused(self, factor: Self, addend: Self) -> Self {
                // Elsewhere the crate `wide` rounds twice.
                if cfg!(any(target_feature = "fma", target_arch = "aarch64")) {
                    return $vector(self.0.mul_add(factor.0, addend.0));
                }
                let (left, right) = (self.0.to_array(), factor.0.to_array());
                let (addend, mut found) = (addend.0.to_array(), [0.0; $lanes]);
                let mut lane = 0;
                while lane < $lanes {
                    found[lane] = left[lane].fused(right[lane], addend[lane]);
                    lane += 1;
                }
                $vector($wide::new(found))
            }
        }

        impl Floats<$float> for $vector {
            type Bits = $bits;

            #[inline(always)]
            fn bits(self) -> $bits {
                cast(self.0)
            }
            #[inline(always)]
            fn of_bits(bits: $bits) -> Self {
                $vector(cast(bits))
            }
            #[inline(always)]
            fn power(self, exponent: usize) -> $bits {
                $bits::splat(1 << exponent)
            }
            #[inline(always)]
            fn raised(bits: $bits) -> $bits {
                bits << ($float::SIGN as u32 - 1)
            }

            #[inline(always)]
            fn are_within(self, largest: $float) -> bool {
                // Not `all`, which branches where a vector is two of the processor's.
                let within = self.0.abs().simd_le($wide::splat(largest));
                within.to_bitmask() == (1 << $lanes) - 1
            }
        }

        impl Vector<$float> for $vector {
            const LANES: usize = $lanes;

            // Loops over indices: only they are inlined for certain, not closures and iterators.
            #[inline(always)]
            fn sincos<const N: usize>(
                angles: &[$float; N],
                sines: &mut [$float; N],
                cosines: &mut [$float; N],
                start: usize,
            ) -> bool {
                let mut taken = [0.0; $lanes];
                let mut lane = 0;
                while lane < $lanes {
                    let from = if start + lane < N { start + lane } else { N - 1 };
                    taken[lane] = angles[from];
                    lane += 1;
                }
                let angle = $vector($wide::new(taken));
                let (shifted, sin, cos) = rest::<$float, Rounded, _>(angle);
                let (sin, cos) = turned(shifted, sin, cos);
                let (sin, cos) = (sin.0.to_array(), cos.0.to_array());
                let mut lane = 0;
                while lane < $lanes && start + lane < N {
                    sines[start + lane] = sin[lane];
                    cosines[start + lane] = cos[lane];
                    lane += 1;
                }
                angle.are_within($float::LARGEST)
            }
        }
    };
}
vector!(TwoDoubles, f64x2, u64x2, f64, 2);
vector!(FourDoubles, f64x4, u64x4, f64, 4);
vector!(FourFloats, f32x4, u32x4, f32, 4);
vector!(EightFloats, f32x8, u32x8, f32, 8);

macro_rules! batched {
    ($vector:ident, $wide:ident, $float:ident, $lanes:literal) => {
        impl $vector {
            #[inline(always)]
            pub fn from_array(array: [$float; $lanes]) -> Self {
                $vector($wide::new(array))
            }
            #[inline(always)]
            pub fn to_array(self) -> [$float; $lanes] {
                self.0.to_array()
            }
            #[inline(always)]
            pub fn root(self) -> Self {
                $vector(self.0.sqrt())
            }
        }
    };
}
batched!(TwoDoubles, f64x2, f64, 2);
batched!(FourFloats, f32x4, f32, 4);
