//! Which vectors there are of a float.

use dalembert_sines::text::Angle;

use crate::vector::Vector;
#[cfg(all(feature = "std", target_arch = "x86_64"))]
use crate::x86;

/// A float that a function computes in.
pub trait Float: Angle + 'static {
    /// Its vector of the target as it is compiled for.
    type Portable: Vector<Self, Token = ()>;
    /// Its vector of 256 bits.
    #[cfg(all(feature = "std", target_arch = "x86_64"))]
    type Avx2: Vector<Self, Token = pulp::x86::V3>;
    /// Its vector of 512 bits.
    #[cfg(all(feature = "std", target_arch = "x86_64"))]
    type Avx512: Vector<Self, Token = pulp::x86::V4>;
}

impl Float for f64 {
    type Portable = dalembert_sines::text::Doubles;
    #[cfg(all(feature = "std", target_arch = "x86_64"))]
    type Avx2 = x86::FourDoubles;
    #[cfg(all(feature = "std", target_arch = "x86_64"))]
    type Avx512 = x86::EightDoubles;
}

impl Float for f32 {
    type Portable = dalembert_sines::text::Singles;
    #[cfg(all(feature = "std", target_arch = "x86_64"))]
    type Avx2 = x86::EightFloats;
    #[cfg(all(feature = "std", target_arch = "x86_64"))]
    type Avx512 = x86::SixteenFloats;
}
