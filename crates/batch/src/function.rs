//! A generated function as batches see it, and the vectors that there are of its float.

use dalembert_sines::text::{Angle, Floats};

use crate::Vector;
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

/// A function of arguments with E entries in all, which returns M numbers and takes sines and
/// cosines of K angles; of one state, or of as many as a vector has lanes.
///
/// Its methods must be `#[inline(always)]`: they are compiled for the vectors of their caller.
pub trait Function<const E: usize, const M: usize, const K: usize> {
    /// f64 or f32.
    type Scalar: Float;
    /// Says whether the sines fuse their products as well, as the function's text does.
    const FUSED: bool = false;

    /// Returns the angles whose sines and cosines [`vectors`](Function::vectors) takes.
    fn angles<V: Floats<Self::Scalar>>(entries: &[V; E]) -> [V; K];

    /// Returns the numbers of the results in their order.
    fn vectors<V: Vector<Self::Scalar>>(entries: &[V; E], sin: &[V; K], cos: &[V; K]) -> [V; M];
}
