//! As wide as the processor's vectors are.
//!
//! One vector at a time: with two of them, values do not stay in registers (PUMA's torques with
//! AVX2, f64: 16.8 ns with four lanes, 21 to 27 with eight).

#[cfg(all(feature = "std", target_arch = "x86_64"))]
use pulp::x86::{V3, V4};

#[cfg(all(feature = "std", target_arch = "x86_64"))]
use crate::Vector;
use crate::argument::{Argument, Entries};
use crate::slices::{run_columns, states_of};
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
        let vectors = wider.find(|vectors| vectors.are_there());
        vectors.unwrap_or(Vectors::Portable)
    }

    /// True if the processor has them; without the feature `std` nobody asks it.
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

/// Computes the function at every state: of its E entries R come in rows, the others in columns.
///
/// # Errors
/// [`Unequal`]; then nothing is computed.
pub fn columns<F, const E: usize, const M: usize, const K: usize, const R: usize>(
    arguments: &[Argument<'_, F::Scalar>],
    results: &mut [&mut [F::Scalar]; M],
) -> Result<(), Unequal>
where
    F: Function<E, M, K>,
{
    columns_in::<F, E, M, K, R>(Vectors::widest(), arguments, results)
}

/// [`columns`] in vectors of the caller's choice; where the processor lacks them, in portable
/// ones. The bits are the same.
///
/// # Errors
/// [`Unequal`]; then nothing is computed.
pub fn columns_in<F, const E: usize, const M: usize, const K: usize, const R: usize>(
    vectors: Vectors,
    arguments: &[Argument<'_, F::Scalar>],
    results: &mut [&mut [F::Scalar]; M],
) -> Result<(), Unequal>
where
    F: Function<E, M, K>,
{
    let states = states_of(results)?;
    let entries = Entries::<F::Scalar, E, R>::of(arguments, states)?;
    entries_in::<F, E, M, K, R>(vectors, &entries, results);
    Ok(())
}

/// The slices are of one length.
pub(crate) fn entries_in<F, const E: usize, const M: usize, const K: usize, const R: usize>(
    vectors: Vectors,
    entries: &Entries<'_, F::Scalar, E, R>,
    results: &mut [&mut [F::Scalar]; M],
) where
    F: Function<E, M, K>,
{
    match results.first().map_or(0, |first| first.len()) {
        0 => {}
        states @ 1..BLOCK => few_columns::<F, E, M, K, R>(vectors, entries, results, states),
        _ => run::<F, E, M, K, R>(vectors, entries, results, 0),
    }
}

#[inline(never)]
fn few_columns<F, const E: usize, const M: usize, const K: usize, const R: usize>(
    vectors: Vectors,
    entries: &Entries<'_, F::Scalar, E, R>,
    results: &mut [&mut [F::Scalar]; M],
    states: usize,
) where
    F: Function<E, M, K>,
{
    let blocks = entries.few(states);
    let entries = Entries::<F::Scalar, E, 0>::of_blocks(&blocks);
    let mut result_blocks = [[F::Scalar::default(); BLOCK]; M];
    let from = BLOCK - states;
    let mut columns = result_blocks.each_mut().map(|column| &mut column[..]);
    run::<F, E, M, K, 0>(vectors, &entries, &mut columns, from);
    for (column, block) in results.iter_mut().zip(&result_blocks) {
        column.copy_from_slice(&block[from..]);
    }
}

fn run<F, const E: usize, const M: usize, const K: usize, const R: usize>(
    vectors: Vectors,
    entries: &Entries<'_, F::Scalar, E, R>,
    results: &mut [&mut [F::Scalar]; M],
    from: usize,
) where
    F: Function<E, M, K>,
{
    #[cfg(all(feature = "std", target_arch = "x86_64"))]
    match vectors {
        Vectors::Avx512 => {
            if let Some(token) = V4::try_new() {
                return token.vectorize(Columns::<F, <F::Scalar as Float>::Avx512, E, M, K, R> {
                    token,
                    entries,
                    results,
                    from,
                });
            }
        }
        Vectors::Avx2 => {
            if let Some(token) = V3::try_new() {
                return token.vectorize(Columns::<F, <F::Scalar as Float>::Avx2, E, M, K, R> {
                    token,
                    entries,
                    results,
                    from,
                });
            }
        }
        Vectors::Portable => {}
    }
    let _ = vectors;
    run_columns::<F, <F::Scalar as Float>::Portable, E, M, K, R>((), entries, results, from);
}

#[cfg(all(feature = "std", target_arch = "x86_64"))]
struct Columns<'a, 'c, 'r, F, V, const E: usize, const M: usize, const K: usize, const R: usize>
where
    F: Function<E, M, K>,
    V: Vector<F::Scalar>,
{
    token: V::Token,
    entries: &'a Entries<'a, F::Scalar, E, R>,
    results: &'r mut [&'c mut [F::Scalar]; M],
    from: usize,
}

#[cfg(all(feature = "std", target_arch = "x86_64"))]
impl<F, V, const E: usize, const M: usize, const K: usize, const R: usize> pulp::NullaryFnOnce
    for Columns<'_, '_, '_, F, V, E, M, K, R>
where
    F: Function<E, M, K>,
    V: Vector<F::Scalar>,
{
    type Output = ();

    // Inlined into what is compiled for the vectors.
    #[inline(always)]
    fn call(self) {
        run_columns::<F, V, E, M, K, R>(self.token, self.entries, self.results, self.from);
    }
}
