//! A generated function as batches see it.

use dalembert_sines::text::Floats;

use crate::{Float, Vector};

/// A function of A arguments of N numbers each, which returns M numbers and takes sines and
/// cosines of K angles; of one state, or of as many as a vector has lanes.
///
/// Its methods must be `#[inline(always)]`: they are compiled for the vectors of
/// whoever calls them.
pub trait Function<const A: usize, const N: usize, const M: usize, const K: usize> {
    /// f64 or f32.
    type Scalar: Float;
    /// Says whether the sines fuse their products as well, as the function's text does.
    const FUSED: bool = false;

    /// Returns the angles whose sines and cosines [`vectors`](Function::vectors) takes.
    fn angles<V: Floats<Self::Scalar>>(arguments: &[[V; N]; A]) -> [V; K];

    /// Returns the numbers of the results in their order.
    fn vectors<V: Vector<Self::Scalar>>(
        arguments: &[[V; N]; A],
        sin: &[V; K],
        cos: &[V; K],
    ) -> [V; M];
}
