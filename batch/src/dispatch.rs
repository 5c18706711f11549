//! As wide as the processor's vectors are.
//!
//! As many lanes as a vector has: with twice as many, values do not stay in
//! registers (PUMA's torques with AVX2, f64: 16.8 ns with four lanes, 21 to 27
//! with eight).

use core::marker::PhantomData;

use pulp::{Arch, Simd, WithSimd};

use crate::slices::{check_columns, check_states, run_columns, run_states};
use crate::{Function, Unequal};

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
    check_states(&arguments, results.len())?;
    Arch::new().dispatch(States::<F, A, N, M> { arguments, results });
    Ok(())
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
    check_columns(&arguments, results)?;
    Arch::new().dispatch(Columns::<F, A, N, M> {
        arguments,
        results,
        function: PhantomData,
    });
    Ok(())
}

struct States<'a, F: Function<A, N, M>, const A: usize, const N: usize, const M: usize> {
    arguments: [&'a [[F::Scalar; N]]; A],
    results: &'a mut [F::State],
}

struct Columns<'a, 'c, 'r, F: Function<A, N, M>, const A: usize, const N: usize, const M: usize> {
    arguments: [&'a [&'a [F::Scalar]; N]; A],
    results: &'r mut [&'c mut [F::Scalar]; M],
    function: PhantomData<F>,
}

/// Returns the number of lanes of a vector.
const fn lanes<S: Simd, T>() -> usize {
    size_of::<S::f64s>() / size_of::<T>()
}

impl<F, const A: usize, const N: usize, const M: usize> WithSimd for States<'_, F, A, N, M>
where
    F: Function<A, N, M>,
{
    type Output = ();

    // Inlined into what is compiled for the vectors.
    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let (arguments, results) = (self.arguments, self.results);
        match const { lanes::<S, F::Scalar>() } {
            16.. => run_states::<F, 16, A, N, M>(arguments, results),
            8.. => run_states::<F, 8, A, N, M>(arguments, results),
            // A plain build has vectors of two doubles, of which four lanes take
            // two: the fastest there.
            _ => run_states::<F, 4, A, N, M>(arguments, results),
        }
    }
}

impl<F, const A: usize, const N: usize, const M: usize> WithSimd for Columns<'_, '_, '_, F, A, N, M>
where
    F: Function<A, N, M>,
{
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let (arguments, results) = (self.arguments, self.results);
        match const { lanes::<S, F::Scalar>() } {
            16.. => run_columns::<F, 16, A, N, M>(arguments, results),
            8.. => run_columns::<F, 8, A, N, M>(arguments, results),
            _ => run_columns::<F, 4, A, N, M>(arguments, results),
        }
    }
}
