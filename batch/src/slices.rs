//! From slices to vectors and back.
//!
//! Loops over indices stand here in place of closures and iterators: all of it must be
//! compiled for the same vectors as the function is, and only what is inlined for
//! certain is. (`zip` is not, without link-time optimisation of a crate's parts.)

use core::ops::Range;

use dalembert_sines::text::{Fused, Rounded, alone};

use crate::block::{Block, InColumns, InRows, columns_of, rows_of};
use crate::vector::BLOCK;
use crate::{Function, Slice, Unequal, Vector};

/// Checks that there is an argument of each for every result.
pub(crate) fn check_states<T, const N: usize>(
    arguments: &[&[[T; N]]],
    states: usize,
) -> Result<(), Unequal> {
    for (index, argument) in (1..).zip(arguments) {
        Unequal::check(Slice::Argument(index), argument.len(), states)?;
    }
    Ok(())
}

/// Checks that all columns are of one length.
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

/// Numbers of which no vector straddles two lines of the cache, wherever the stack begins.
#[repr(align(64))]
struct Aligned<T>(T);

/// No vector has more lanes.
const MOST_LANES: usize = 16;

/// The sines or cosines of a block.
type Sines<T, const K: usize> = Aligned<[[T; BLOCK]; K]>;

/// Runs a function over columns of one length, of at least a block, from a state on.
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
        let Some(columns) = columns_of(arguments, begin) else {
            return;
        };
        let block = InColumns(columns);
        let vectors = (start - begin) / V::LANES..BLOCK / V::LANES;
        take_sines::<F, V, _, A, N, M, K>(token, &block, &mut sin, &mut cos, vectors.clone());
        let mut after = vectors.start;
        while after < vectors.end {
            let found = at::<F, V, _, A, N, M, K>(token, &block, &sin, &cos, after);
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

/// Computes the states of slices of one length, of at least a block, from a state on, of which
/// there are results.
#[inline(always)]
pub(crate) fn run_states<F, V, const A: usize, const N: usize, const M: usize, const K: usize>(
    token: V::Token,
    arguments: [&[[F::Scalar; N]]; A],
    results: &mut [F::State],
    from: usize,
) where
    F: Function<A, N, M, K>,
    V: Vector<F::Scalar>,
{
    let states = from + results.len();
    let zeros = [F::Scalar::default(); BLOCK];
    let (mut sin, mut cos) = (Aligned([zeros; K]), Aligned([zeros; K]));
    let mut numbers = Aligned([[F::Scalar::default(); M]; MOST_LANES]);
    let mut start = from;
    while start < states {
        let begin = start.min(states.saturating_sub(BLOCK));
        let Some(rows) = rows_of(arguments, begin) else {
            return;
        };
        let block = InRows(rows);
        let vectors = (start - begin) / V::LANES..BLOCK / V::LANES;
        take_sines::<F, V, _, A, N, M, K>(token, &block, &mut sin, &mut cos, vectors.clone());
        let mut after = vectors.start;
        while after < vectors.end {
            let found = at::<F, V, _, A, N, M, K>(token, &block, &sin, &cos, after);
            V::rows(&found, &mut numbers.0);
            let first = begin + after * V::LANES;
            let place = first.wrapping_sub(from);
            if let Some(places) = results.get_mut(place..place.wrapping_add(V::LANES)) {
                let mut lane = 0;
                while lane < V::LANES.min(places.len()) {
                    places[lane] = F::state(numbers.0[lane]);
                    lane += 1;
                }
            } else {
                let before = from.saturating_sub(first);
                write_first::<F, A, N, M, K>(&numbers.0[before..V::LANES], results);
            }
            after += 1;
        }
        start = begin + BLOCK;
    }
}

/// Writes the results of a vector that begins before the first state there is one of.
#[cold]
#[inline(never)]
fn write_first<F, const A: usize, const N: usize, const M: usize, const K: usize>(
    numbers: &[[F::Scalar; M]],
    results: &mut [F::State],
) where
    F: Function<A, N, M, K>,
{
    for (result, numbers) in results.iter_mut().zip(numbers) {
        *result = F::state(*numbers);
    }
}

/// Computes the sines of vectors of a block.
#[inline(always)]
fn take_sines<F, V, B, const A: usize, const N: usize, const M: usize, const K: usize>(
    token: V::Token,
    block: &B,
    sin: &mut Sines<F::Scalar, K>,
    cos: &mut Sines<F::Scalar, K>,
    vectors: Range<usize>,
) where
    F: Function<A, N, M, K>,
    V: Vector<F::Scalar>,
    B: Block<F::Scalar, V, A, N>,
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
        one_by_one::<F, V, B, A, N, M, K>(block, sin, cos);
    }
}

/// Returns the results of the vector of a block that stands after so many others.
#[inline(always)]
fn at<F, V, B, const A: usize, const N: usize, const M: usize, const K: usize>(
    token: V::Token,
    block: &B,
    sin: &Sines<F::Scalar, K>,
    cos: &Sines<F::Scalar, K>,
    after: usize,
) -> [V; M]
where
    F: Function<A, N, M, K>,
    V: Vector<F::Scalar>,
    B: Block<F::Scalar, V, A, N>,
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
fn one_by_one<F, V, B, const A: usize, const N: usize, const M: usize, const K: usize>(
    block: &B,
    sin: &mut Sines<F::Scalar, K>,
    cos: &mut Sines<F::Scalar, K>,
) where
    F: Function<A, N, M, K>,
    V: Vector<F::Scalar>,
    B: Block<F::Scalar, V, A, N>,
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
