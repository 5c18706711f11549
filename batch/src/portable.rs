//! Compiled for the target as it is.

use crate::{Function, Unequal, columns_in_lanes, states_in_lanes};

/// The number of lanes: two vectors of SSE or NEON in f64, one in f32. A plain x86-64 build was
/// fastest with these.
const LANES: usize = 4;

/// The function at every state.
///
/// # Errors
/// [`Unequal`]; then nothing is computed.
pub fn states<F, const A: usize, const N: usize, const M: usize>(
    arguments: [&[[F::Scalar; N]]; A],
    results: &mut [F::State],
) -> Result<(), Unequal>
where
    F: Function<A, N, M>,
{
    states_in_lanes::<F, LANES, A, N, M>(arguments, results)
}

/// The function at every state, whose numbers stand in columns.
///
/// # Errors
/// [`Unequal`]; then nothing is computed.
pub fn columns<F, const A: usize, const N: usize, const M: usize>(
    arguments: [&[&[F::Scalar]; N]; A],
    results: &mut [&mut [F::Scalar]; M],
) -> Result<(), Unequal>
where
    F: Function<A, N, M>,
{
    columns_in_lanes::<F, LANES, A, N, M>(arguments, results)
}
