//! As wide as the processor's vectors are.
//!
//! One vector at a time: with two of them, values do not stay in registers (PUMA's torques with
//! AVX2, f64: 16.8 ns with four lanes, 21 to 27 with eight).

#[cfg(all(feature = "std", target_arch = "x86_64"))]
use pulp::x86::{V3, V4};

#[cfg(all(feature = "std", target_arch = "x86_64"))]
use crate::Vector;
use crate::slices::{check_columns, ending, run_columns};
use crate::vector::BLOCK;
use crate::{Float, Function, Unequal};

/// The vectors that a batch is computed in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Vectors {
    /// Those of the target that the program was compiled for.
    Portable,
    /// Those of AVX2 with fused products, of 256 bits.
    Avx2,
    /// Those of AVX-512, of 512 bits.
    Avx512,
}

impl Vectors {
    /// Returns the widest that the processor has.
    #[must_use]
    pub fn widest() -> Vectors {
        let mut wider = [Vectors::Avx512, Vectors::Avx2].into_iter();
        let found = wider.find(|vectors| vectors.are_there());
        found.unwrap_or(Vectors::Portable)
    }

    /// Returns whether the processor has them; without the feature `std` nobody asks it.
    #[must_use]
    pub fn are_there(self) -> bool {
        match self {
            Vectors::Portable => true,
            #[cfg(all(feature = "std", target_arch = "x86_64"))]
            Vectors::Avx2 => V3::is_available(),
            #[cfg(all(feature = "std", target_arch = "x86_64"))]
            Vectors::Avx512 => V4::is_available(),
            #[cfg(not(all(feature = "std", target_arch = "x86_64")))]
            Vectors::Avx2 | Vectors::Avx512 => false,
        }
    }
}

/// Computes the function at every state, whose numbers stand in columns.
///
/// # Errors
/// [`Unequal`]; then nothing is computed.
pub fn columns<F, const A: usize, const N: usize, const M: usize, const K: usize>(
    arguments: [&[&[F::Scalar]; N]; A],
    results: &mut [&mut [F::Scalar]; M],
) -> Result<(), Unequal>
where
    F: Function<A, N, M, K>,
{
    columns_in::<F, A, N, M, K>(Vectors::widest(), arguments, results)
}

/// [`columns`] in vectors of the caller's choice; where the processor lacks them, in portable
/// ones. The bits are the same.
///
/// # Errors
/// [`Unequal`]; then nothing is computed.
pub fn columns_in<F, const A: usize, const N: usize, const M: usize, const K: usize>(
    vectors: Vectors,
    arguments: [&[&[F::Scalar]; N]; A],
    results: &mut [&mut [F::Scalar]; M],
) -> Result<(), Unequal>
where
    F: Function<A, N, M, K>,
{
    let states = check_columns(&arguments, results)?;
    match states {
        0 => {}
        1..BLOCK => few_columns::<F, A, N, M, K>(vectors, arguments, results, states),
        _ => run::<F, A, N, M, K>(vectors, arguments, results, 0),
    }
    Ok(())
}

#[inline(never)]
fn few_columns<F, const A: usize, const N: usize, const M: usize, const K: usize>(
    vectors: Vectors,
    arguments: [&[&[F::Scalar]; N]; A],
    results: &mut [&mut [F::Scalar]; M],
    states: usize,
) where
    F: Function<A, N, M, K>,
{
    let blocks = arguments.map(|columns| columns.map(ending));
    let slices = blocks
        .each_ref()
        .map(|columns| columns.each_ref().map(|column| &column[..]));
    let mut found = [[F::Scalar::default(); BLOCK]; M];
    let from = BLOCK - states;
    let mut columns = found.each_mut().map(|column| &mut column[..]);
    run::<F, A, N, M, K>(vectors, slices.each_ref(), &mut columns, from);
    for (column, found) in results.iter_mut().zip(&found) {
        column.copy_from_slice(&found[from..]);
    }
}

fn run<F, const A: usize, const N: usize, const M: usize, const K: usize>(
    vectors: Vectors,
    arguments: [&[&[F::Scalar]; N]; A],
    results: &mut [&mut [F::Scalar]; M],
    from: usize,
) where
    F: Function<A, N, M, K>,
{
    #[cfg(all(feature = "std", target_arch = "x86_64"))]
    match vectors {
        Vectors::Avx512 => {
            if let Some(token) = V4::try_new() {
                return token.vectorize(Columns::<F, <F::Scalar as Float>::Avx512, A, N, M, K> {
                    token,
                    arguments,
                    results,
                    from,
                });
            }
        }
        Vectors::Avx2 => {
            if let Some(token) = V3::try_new() {
                return token.vectorize(Columns::<F, <F::Scalar as Float>::Avx2, A, N, M, K> {
                    token,
                    arguments,
                    results,
                    from,
                });
            }
        }
        Vectors::Portable => {}
    }
    let _ = vectors;
    run_columns::<F, <F::Scalar as Float>::Portable, A, N, M, K>((), arguments, results, from);
}

#[cfg(all(feature = "std", target_arch = "x86_64"))]
struct Columns<'a, 'c, 'r, F, V, const A: usize, const N: usize, const M: usize, const K: usize>
where
    F: Function<A, N, M, K>,
    V: Vector<F::Scalar>,
{
    token: V::Token,
    arguments: [&'a [&'a [F::Scalar]; N]; A],
    results: &'r mut [&'c mut [F::Scalar]; M],
    from: usize,
}

#[cfg(all(feature = "std", target_arch = "x86_64"))]
impl<F, V, const A: usize, const N: usize, const M: usize, const K: usize> pulp::NullaryFnOnce
    for Columns<'_, '_, '_, F, V, A, N, M, K>
where
    F: Function<A, N, M, K>,
    V: Vector<F::Scalar>,
{
    type Output = ();

    // Inlined into what is compiled for the vectors.
    #[inline(always)]
    fn call(self) {
        run_columns::<F, V, A, N, M, K>(self.token, self.arguments, self.results, self.from);
    }
}
