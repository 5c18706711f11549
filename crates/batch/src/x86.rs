//! The vectors of AVX2 and AVX-512, by the crate `pulp`: a program finds out which of them there
//! are, and what computes with them is compiled for them.

use core::ops::{Add, BitAnd, BitXor, Div, Mul, Neg, Sub};

use dalembert_sines::text::{self, Floats, Number, Products};
use pulp::x86::{V3, V4};
use pulp::{Simd, cast, f32x8, f32x16, f64x4, f64x8, u32x8, u32x16, u64x4, u64x8};

use crate::vector::{BLOCK, Vector, lanes};

macro_rules! operation {
    ($vector:ident, $operation:ident, $method:ident, $by:ident) => {
        impl $operation for $vector {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                $vector(self.0, self.0.$by(self.1, other.1))
            }
        }
    };
}

macro_rules! scalar {
    ($vector:ident, $float:ident, $operation:ident, $method:ident, $all:ident, $by:ident) => {
        operation!($vector, $operation, $method, $by);

        impl $operation<$float> for $vector {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: $float) -> Self {
                $vector(self.0, self.0.$by(self.1, self.0.$all(other)))
            }
        }
    };
}

macro_rules! vector {
    ($token:ident, $lanes:literal, $float:ident, $vector:ident, $raw:ident, $bits:ident,
     $raw_bits:ident, $raised:literal; $add:ident, $sub:ident, $mul:ident, $div:ident, $neg:ident,
     $sqrt:ident, $fused:ident, $abs:ident, $at_most:ident, $all:ident; $xor:ident, $and:ident,
     $plus:ident, $minus:ident, $power:ident, $shift:ident; |$mask:ident| $every:expr) => {
        #[doc = concat!("`", stringify!($raw), "`, with what shows that there are such.")]
        #[derive(Clone, Copy)]
        pub struct $vector($token, $raw);

        /// Its bits.
        #[derive(Clone, Copy)]
        pub struct $bits($token, $raw_bits);

        scalar!($vector, $float, Add, add, $all, $add);
        scalar!($vector, $float, Sub, sub, $all, $sub);
        scalar!($vector, $float, Mul, mul, $all, $mul);
        operation!($vector, Div, div, $div);
        operation!($bits, BitXor, bitxor, $xor);
        operation!($bits, BitAnd, bitand, $and);
        operation!($bits, Add, add, $plus);
        operation!($bits, Sub, sub, $minus);

        impl Neg for $vector {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                $vector(self.0, self.0.$neg(self.1))
            }
        }

        impl Number<$float> for $vector {
            #[inline(always)]
            fn all(self, value: $float) -> Self {
                $vector(self.0, self.0.$all(value))
            }
            #[inline(always)]
            fn fused(self, factor: Self, addend: Self) -> Self {
                $vector(self.0, self.0.$fused(self.1, factor.1, addend.1))
            }
        }

        impl Floats<$float> for $vector {
            type Bits = $bits;

            #[inline(always)]
            fn bits(self) -> $bits {
                $bits(self.0, cast(self.1))
            }
            #[inline(always)]
            fn of_bits(bits: $bits) -> Self {
                $vector(bits.0, cast(bits.1))
            }
            #[inline(always)]
            fn power(self, exponent: usize) -> $bits {
                $bits(self.0, self.0.$power(1 << exponent))
            }
            #[inline(always)]
            fn raised(bits: $bits) -> $bits {
                $bits(bits.0, bits.0.$shift::<$raised>(bits.1))
            }

            #[inline(always)]
            fn are_within(self, largest: $float) -> bool {
                let simd = self.0;
                let $mask = simd.$at_most(simd.$abs(self.1), simd.$all(largest));
                $every
            }
        }

        impl Vector<$float> for $vector {
            type Token = $token;

            lanes!($float, $lanes; |vector| cast(vector.1); |vector| vector.0;
                   |token, from| $vector(token, cast(from)));

            #[inline(always)]
            fn sqrt(self) -> Self {
                $vector(self.0, self.0.$sqrt(self.1))
            }
        }
    };
}

macro_rules! doubles {
    ($token:ident, $lanes:literal; $vector:ident, $raw:ident; $bits:ident, $raw_bits:ident,
     $shift:ident; |$mask:ident| $every:expr) => {
        vector!(
            $token, $lanes, f64, $vector, $raw, $bits, $raw_bits, 62;
            add_f64s, sub_f64s, mul_f64s, div_f64s, neg_f64s, sqrt_f64s, mul_add_f64s, abs_f64s,
            less_than_or_equal_f64s, splat_f64s;
            xor_u64s, and_u64s, add_u64s, sub_u64s, splat_u64s, $shift; |$mask| $every
        );
    };
}

macro_rules! floats {
    ($token:ident, $lanes:literal; $vector:ident, $raw:ident; $bits:ident, $raw_bits:ident,
     $shift:ident; |$mask:ident| $every:expr) => {
        vector!(
            $token, $lanes, f32, $vector, $raw, $bits, $raw_bits, 30;
            add_f32s, sub_f32s, mul_f32s, div_f32s, neg_f32s, sqrt_f32s, mul_add_f32s, abs_f32s,
            less_than_or_equal_f32s, splat_f32s;
            xor_u32s, and_u32s, add_u32s, sub_u32s, splat_u32s, $shift; |$mask| $every
        );
    };
}

doubles!(V4, 8; EightDoubles, f64x8; EightWords, u64x8, shl_const_u64x8;
         |mask| mask.0 == u8::MAX);
floats!(V4, 16; SixteenFloats, f32x16; SixteenHalves, u32x16, shl_const_u32x16;
        |mask| mask.0 == u16::MAX);
doubles!(V3, 4; FourDoubles, f64x4; FourWords, u64x4, shl_const_u64x4;
         |mask| cast::<_, [u64; 4]>(mask) == [u64::MAX; 4]);
floats!(V3, 8; EightFloats, f32x8; EightHalves, u32x8, shl_const_u32x8;
        |mask| cast::<_, [u32; 8]>(mask) == [u32::MAX; 8]);
