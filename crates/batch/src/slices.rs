//! From columns to vectors and back.
//!
//! Loops over indices stand here in place of closures and iterators: all of it must be
//! compiled for the same vectors as the function is, and only what is inlined for
//! certain is. (`zip` is not, without link-time optimisation of a crate's parts.)

use core::array::from_fn;
use core::ops::Range;

use dalembert_sines::text::{Fused, Rounded, alone};

use crate::vector::BLOCK;
use crate::{Function, Slice, Unequal, Vector};

pub(crate) fn check_columns<T, const N: usize>(
    arguments: &[&[&[T]; N]],
    results: &[&mut [T]],
) -> Result<usize, Unequal> {
    let states = results.first().map_or(0, |first| first.len());
    for (index, column) in (1..).zip(results) {
        Unequal::check(Slice::Result(index), column.len(), states)?;
    }
    for (index, argument) in (1..).zip(arguments) {
        for (entry, column) in (1..).zip(argument.iter()) {
            Unequal::check(Slice::Entry(index, entry), column.len(), states)?;
        }
    }
    Ok(states)
}

/// So many states of columns.
struct Block<'a, T, const A: usize, const N: usize>([[&'a [T; BLOCK]; N]; A]);

impl<'a, T: Copy, const A: usize, const N: usize> Block<'a, T, A, N> {
    /// Returns the block that begins at a state. It ends early where there is none: of
    /// a loop that did not, compilers would make vectors of addresses, which are slower.
    #[inline(always)]
    fn at(arguments: [&'a [&'a [T]; N]; A], begin: usize) -> Option<Self> {
        let first = arguments.first()?.first()?.get(begin..)?.first_chunk()?;
        let mut block = [[first; N]; A];
        let mut argument = 0;
        while argument < A {
            let mut entry = 0;
            while entry < N {
                block[argument][entry] = arguments[argument][entry].get(begin..)?.first_chunk()?;
                entry += 1;
            }
            argument += 1;
        }
        Some(Block(block))
    }

    #[inline(always)]
    fn vectors<V: Vector<T>>(&self, token: V::Token, after: usize) -> [[V; N]; A] {
        let mut vectors = [[V::load(token, self.0[0][0], after); N]; A];
        let mut argument = 0;
        while argument < A {
            let mut entry = 0;
            while entry < N {
                vectors[argument][entry] = V::load(token, self.0[argument][entry], after);
                entry += 1;
            }
            argument += 1;
        }
        vectors
    }

    fn state(&self, state: usize) -> [[T; N]; A] {
        self.0.map(|argument| argument.map(|column| column[state]))
    }
}

/// Returns a block that ends with a slice, before which its first entry stands: of a state that
/// somebody asked for, no library's slow path is taken that would not be taken anyway.
pub(crate) fn ending<T: Copy>(slice: &[T]) -> [T; BLOCK] {
    from_fn(|at| slice[(at + slice.len()).saturating_sub(BLOCK)])
}

/// Numbers of which no vector straddles two lines of the cache, wherever the stack begins.
#[repr(align(64))]
struct Aligned<T>(T);

type Sines<T, const K: usize> = Aligned<[[T; BLOCK]; K]>;

#[inline(always)]
pub(crate) fn run_columns<F, V, const A: usize, const N: usize, const M: usize, const K: usize>(
    token: V::Token,
    arguments: [&[&[F::Scalar]; N]; A],
    results: &mut [&mut [F::Scalar]; M],
    from: usize,
) where
    F: Function<A, N, M, K>,
    V: Vector<F::Scalar>,
{
    let states = results.first().map_or(0, |first| first.len());
    let zeros = [F::Scalar::default(); BLOCK];
    let (mut sin, mut cos) = (Aligned([zeros; K]), Aligned([zeros; K]));
    let mut start = from;
    while start < states {
        // The last block begins in the one before, in whose last vectors what comes again is the
        // same: so there are no others than whole ones.
        let begin = start.min(states.saturating_sub(BLOCK));
        let Some(block) = Block::at(arguments, begin) else {
            return;
        };
        let vectors = (start - begin) / V::LANES..BLOCK / V::LANES;
        take_sines::<F, V, A, N, M, K>(token, &block, &mut sin, &mut cos, vectors.clone());
        let mut after = vectors.start;
        while after < vectors.end {
            let found = at::<F, V, A, N, M, K>(token, &block, &sin, &cos, after);
            let mut result = 0;
            while result < M {
                found[result].store(&mut *results[result], begin + after * V::LANES);
                result += 1;
            }
            after += 1;
        }
        start = begin + BLOCK;
    }
}

#[inline(always)]
fn take_sines<F, V, const A: usize, const N: usize, const M: usize, const K: usize>(
    token: V::Token,
    block: &Block<'_, F::Scalar, A, N>,
    sin: &mut Sines<F::Scalar, K>,
    cos: &mut Sines<F::Scalar, K>,
    vectors: Range<usize>,
) where
    F: Function<A, N, M, K>,
    V: Vector<F::Scalar>,
{
    let mut usual = true;
    let mut after = vectors.start;
    while K > 0 && after < vectors.end {
        let angles = F::angles(&block.vectors(token, after));
        let (sines, cosines, all) = match F::FUSED {
            true => V::sincos::<Fused, K>(&angles),
            false => V::sincos::<Rounded, K>(&angles),
        };
        let mut angle = 0;
        while angle < K {
            sines[angle].store(&mut sin.0[angle], after * V::LANES);
            cosines[angle].store(&mut cos.0[angle], after * V::LANES);
            angle += 1;
        }
        usual &= all;
        after += 1;
    }
    if !usual {
        one_by_one::<F, A, N, M, K>(block, sin, cos);
    }
}

#[inline(always)]
fn at<F, V, const A: usize, const N: usize, const M: usize, const K: usize>(
    token: V::Token,
    block: &Block<'_, F::Scalar, A, N>,
    sin: &Sines<F::Scalar, K>,
    cos: &Sines<F::Scalar, K>,
    after: usize,
) -> [V; M]
where
    F: Function<A, N, M, K>,
    V: Vector<F::Scalar>,
{
    let arguments = block.vectors(token, after);
    let (mut sines, mut cosines) = ([arguments[0][0]; K], [arguments[0][0]; K]);
    let mut angle = 0;
    while angle < K {
        sines[angle] = V::load(token, &sin.0[angle], after);
        cosines[angle] = V::load(token, &cos.0[angle], after);
        angle += 1;
    }
    F::vectors(&arguments, &sines, &cosines)
}

/// Computes the sines of a block one after the other, where an angle needs a library.
#[cold]
#[inline(never)]
fn one_by_one<F, const A: usize, const N: usize, const M: usize, const K: usize>(
    block: &Block<'_, F::Scalar, A, N>,
    sin: &mut Sines<F::Scalar, K>,
    cos: &mut Sines<F::Scalar, K>,
) where
    F: Function<A, N, M, K>,
{
    for state in 0..BLOCK {
        let arguments = block.state(state);
        for (angle, value) in F::angles(&arguments).into_iter().enumerate() {
            (sin.0[angle][state], cos.0[angle][state]) = match F::FUSED {
                true => alone::<F::Scalar, Fused>(value),
                false => alone::<F::Scalar, Rounded>(value),
            };
        }
    }
}
