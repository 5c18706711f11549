//! Sine and cosine of several angles at once, within one ulp, the same bits on every machine.
//!
//! ```
//! let ([s1, s2], [c1, c2]) = dalembert_sines::sincos(&[0.5, 1e22]);
//! assert_eq!([s1, c2], [0.479425538604203, 0.523214785395139]);
//! assert!(s1 * s1 + c1 * c1 - 1.0 < 1e-15 && s2 == libm::sin(1e22));
//! ```
//!
//! A library's sine has branches: which quarter turn, how large. Here there are none up to
//! [`LARGEST`] ([`LARGEST_F32`]), so that one vector instruction computes as many angles as the
//! processor has room for: two or four doubles, four or eight floats. Beyond, and for NaN and the
//! infinities, the answer is libm's: exact reduction by Payne and Hanek's method, and NaN. One
//! comparison for all angles together says whether that is needed.
//!
//! The vectors are those of the crate `wide`, and all is inlined: what a compiler
//! makes of loops over arrays, it tears apart next to scalar arithmetic (with AVX-512,
//! a PUMA's torques took 102 ns that way), and a call waits for angles that were
//! stored one by one and are loaded together. Against such calls, torques of the
//! PUMA, the Stanford arm, the UR10 and the Panda took 41, 38, 43 and 68 ns for 44, 55,
//! 50 and 74 with AVX-512, and 50, 39, 52 and 83 ns for 45, 55, 56 and 85 in a plain build.
//!
//! Where nothing is optimised, or the processor has no vectors, they are computed one
//! after the other in a call: not optimised, in 2.8 times libm's time.
//!
//! Each angle is computed for itself: among others it gets the bits that it gets alone. Nothing
//! fuses a multiplication with an addition and no platform's library is called, so every machine
//! computes the same; f32 never computes in f64, but for libm's part. It takes `core` alone.
//!
//! # The error
//!
//! u is 2⁻⁵³ in f64 and 2⁻²⁴ in f32, an ulp is the distance of the floats where the true value is.
//! **Proved** below: sines within 0.90 ulp and cosines within 0.85 ulp. **Measured**
//! (`tests/accuracy.rs`): every f32 in range, and 10⁸ f64 with the nearest to multiples of π/4:
//!
//! | | sine | cosine |
//! |---|---|---|
//! | f64, 107 million points | 0.8164 | 0.8166 |
//! | f32, all 1 120 403 457 from 0 to 100, and −x the same | 0.7933 | 0.7999 |
//!
//! ## What is left of the angle
//!
//! k is x·2/π to the nearest integer: x·(2/π) + 1.5·2^(p−1) is rounded to one. The product errs by
//! less than |k|·2u, so |x − kπ/2| ≤ π/4 + |k|·πu < 0.7854, in f32 0.78545. π/2 is P₁ + P₂ + P₃
//! with bits so few that k·P₁ and k·P₂ are exact (`tests.rs` tries every k). Then
//!
//! - x − k·P₁ is exact: both are multiples of 2⁻⁵³ (2⁻²⁴) and it is less than
//!   one; below |x| = 1/2 there is nothing to subtract.
//! - r = (x − k·P₁) − k·P₂ is rounded, and what it lacks is exact: the first is
//!   larger (Dekker's sum), or all are multiples of the last bit of P₂ and so
//!   small that their differences are floats.
//! - k·P₃ is rounded and subtracted from what r lacks, which is rounded too: an
//!   error of 2u·|k·P₃| + u²·|r|, and k·|π/2 − P₁ − P₂ − P₃| is missing. In f64
//!   the first and the last are below 2⁻¹²⁰ and 2⁻¹²², in f32 2⁻⁵⁵ and 2⁻⁵⁷.
//!
//! No f64 in range comes nearer to a multiple of π/2 than 2⁻⁶⁰·⁵, no f32 nearer than 2⁻²⁶·⁴
//! (`tests.rs`, by all multiples). So what is left is known to 2⁻⁵⁹ (2⁻²⁸) of itself: 0.06 ulp for
//! the smallest, where nothing below adds to it, and nothing for others, or where k is 0.
//!
//! ## The sine of r and ℓ
//!
//! With ℓ what r lacks, z = r² and S the polynomial: r − (r·z·S − ℓ·(1 − z/2)).
//! Where |sin| ≥ 1/2, an ulp is u. Half an ulp of the last subtraction; and in
//! the subtrahend, of at most 0.0784, half an ulp each of
//!
//! | of | is at most |
//! |---|---|
//! | the subtrahend, and of its product r·z·S | 0.0625 u each |
//! | z, 0.617 at most, and r·z | 0.064 u, 0.041 u |
//! | the two last operations of S, in sum | 0.121 u |
//! | all other operations of S | 0.005 u |
//! | S against the series: 2⁻⁵⁷·⁶ (2⁻²⁷·⁶) of the sine | 0.030 u (0.059 u) |
//! | ℓ·(cos r − 1 + z/2), with 2·abs(ℓ) ≤ u | 0.008 u |
//!
//! Together 0.395 u in f64, in f32, where S ends in one such operation, 0.365 u: with the half below
//! 0.90 ulp. From 1/4 to 1/2 an ulp is half as large and r³ a third: 0.25 ulp, and less below.
//!
//! ## The cosine
//!
//! With h = z/2, exact, and C the polynomial: t + (((1 − t) − h) + (z²·C − r·ℓ))
//! where t = 1 − h is rounded and (1 − t) − h is what it lacks, exact (Dekker).
//! The result is in [0.707, 1], an ulp u. Half an ulp of the last sum, and
//!
//! | of | is at most |
//! |---|---|
//! | z: half an ulp, times (sin r)/2r | 0.226 u |
//! | z², C and their product | 0.011 u, 0.024 u, 0.008 u |
//! | the two sums of what is small | 0.016 u each |
//! | ℓ·(sin r − r) | 0.040 u |
//! | C against the series, 2⁻⁶³·⁹ (2⁻³²·⁹) | 0.001 u (0.003 u) |
//!
//! Together 0.344 u: less than 0.85 ulp.
//!
//! Underflow takes nothing away: a product that is subnormal is added to a number
//! whose ulp is far above it, or is zero where the sine is the angle itself.
//!
//! ## Fused products
//!
//! Batches of functions whose products are fused fuse them here as well. The exact steps above stay
//! so, and each fused product saves a rounding: the generator's proof gives 0.83 u for both.
#![no_std]
#![forbid(unsafe_code)]

mod angle;
mod constants;
mod number;
#[cfg(test)]
mod tests;
#[cfg(any(
    target_arch = "x86",
    target_arch = "x86_64",
    target_arch = "aarch64",
    target_arch = "wasm32"
))]
mod vectors;

/// Without vectors, one angle after the other.
#[cfg(not(any(
    target_arch = "x86",
    target_arch = "x86_64",
    target_arch = "aarch64",
    target_arch = "wasm32"
)))]
mod vectors {
    pub(crate) use crate::angle::singly as all;
    #[cfg(test)]
    pub(crate) use crate::angle::singly as together;

    pub type TwoDoubles = f64;
    pub type FourFloats = f32;
}

/// The computation as it stands, generic over numbers: what the generator's proof of
/// its error reads, and what batches compute in vectors of their own.
#[doc(hidden)]
pub mod text {
    pub use crate::angle::{Angle, alone, rest, together};
    pub use crate::number::{Floats, Fused, Number, Pair, Products, Rounded};
    pub use crate::vectors::{FourFloats as Singles, TwoDoubles as Doubles};
}

/// Roots, correctly rounded: libm's, for code that has all from here.
pub use libm::{sqrt, sqrtf};

/// Up to this magnitude, 1303 turns, angles are computed here; libm takes the others.
pub const LARGEST: f64 = 8192.0;

/// [`LARGEST`] in f32: 15 turns.
pub const LARGEST_F32: f32 = 100.0;

/// Sines and cosines, in the order of the angles, each within [one ulp](crate#the-error).
///
/// ```
/// let (sin, cos) = dalembert_sines::sincos(&[0.0, -0.0, 1.0]);
/// assert_eq!(cos[..2], [1.0, 1.0]);
/// assert!(sin[0].is_sign_positive() && sin[1].is_sign_negative());
/// ```
#[inline(always)]
#[must_use]
pub fn sincos<const N: usize>(angles: &[f64; N]) -> ([f64; N], [f64; N]) {
    vectors::all(angles)
}

/// Returns [`sincos`] in f32.
///
/// ```
/// let ([sin], [cos]) = dalembert_sines::sincosf(&[100.5f32]);
/// assert_eq!((sin, cos), libm::sincosf(100.5));
/// ```
#[inline(always)]
#[must_use]
pub fn sincosf<const N: usize>(angles: &[f32; N]) -> ([f32; N], [f32; N]) {
    vectors::all(angles)
}
