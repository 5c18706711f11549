//! From columns to vectors and back.
//!
//! Loops over indices stand here in place of closures and iterators: all of it must be
//! compiled for the same vectors as the function is, and only what is inlined for
//! certain is. (`zip` is not, without link-time optimisation of a crate's parts.)

use core::ops::Range;

use dalembert_sines::text::{Fused, Rounded, alone};

use crate::argument::{Entries, RowBlocks};
use crate::vector::BLOCK;
use crate::{Function, Slice, Unequal, Vector};

/// Returns the number of states, which the columns of results have.
pub(crate) fn states_of<T>(results: &[&mut [T]]) -> Result<usize, Unequal> {
    let states = results.first().map_or(0, |first| first.len());
    for (index, column) in (1..).zip(results) {
        Unequal::check(Slice::Result(index), column.len(), states)?;
    }
    Ok(states)
}

type Block<'b, T, const E: usize> = [&'b [T; BLOCK]; E];

#[inline(always)]
fn vectors_of<T, V: Vector<T>, const E: usize>(
    token: V::Token,
    block: &Block<'_, T, E>,
    after: usize,
) -> [V; E] {
    let mut vectors = [V::load(token, block[0], after); E];
    let mut entry = 1;
    while entry < E {
        vectors[entry] = V::load(token, block[entry], after);
        entry += 1;
    }
    vectors
}

/// Numbers of which no vector straddles two lines of the cache, wherever the stack begins.
#[repr(align(64))]
struct CacheLines<T>(T);

type Sines<T, const K: usize> = CacheLines<[[T; BLOCK]; K]>;

#[inline(always)]
pub(crate) fn run_columns<F, V, const E: usize, const M: usize, const K: usize, const R: usize>(
    token: V::Token,
    entries: &Entries<'_, F::Scalar, E, R>,
    results: &mut [&mut [F::Scalar]; M],
    from: usize,
) where
    F: Function<E, M, K>,
    V: Vector<F::Scalar>,
{
    let states = results.first().map_or(0, |first| first.len());
    let zeros = [F::Scalar::default(); BLOCK];
    let (mut sin, mut cos) = (CacheLines([zeros; K]), CacheLines([zeros; K]));
    let mut rows: RowBlocks<F::Scalar, R> = [zeros; R];
    let mut start = from;
    while start < states {
        // The last block begins in the one before, in whose last vectors what comes again is the
        // same: so there are no others than whole ones.
        let begin = start.min(states.saturating_sub(BLOCK));
        if R > 0 {
            entries.fill(&mut rows, start == from, |lane| begin + lane);
        }
        let Some(block) = entries.block(begin, &rows) else {
            return;
        };
        let vectors = (start - begin) / V::LANES..BLOCK / V::LANES;
        take_sines::<F, V, E, M, K>(token, &block, &mut sin, &mut cos, vectors.clone());
        let mut after = vectors.start;
        while after < vectors.end {
            let outputs = at::<F, V, E, M, K>(token, &block, &sin, &cos, after);
            let mut result = 0;
            while result < M {
                outputs[result].store(&mut *results[result], begin + after * V::LANES);
                result += 1;
            }
            after += 1;
        }
        start = begin + BLOCK;
    }
}

#[inline(always)]
fn take_sines<F, V, const E: usize, const M: usize, const K: usize>(
    token: V::Token,
    block: &Block<'_, F::Scalar, E>,
    sin: &mut Sines<F::Scalar, K>,
    cos: &mut Sines<F::Scalar, K>,
    vectors: Range<usize>,
) where
    F: Function<E, M, K>,
    V: Vector<F::Scalar>,
{
    let mut usual = true;
    let mut after = vectors.start;
    while K > 0 && after < vectors.end {
        let angles = F::angles(&vectors_of(token, block, after));
        let (sines, cosines, are_usual) = match F::FUSED {
            true => V::sincos::<Fused, K>(&angles),
            false => V::sincos::<Rounded, K>(&angles),
        };
        let mut angle = 0;
        while angle < K {
            sines[angle].store(&mut sin.0[angle], after * V::LANES);
            cosines[angle].store(&mut cos.0[angle], after * V::LANES);
            angle += 1;
        }
        usual &= are_usual;
        after += 1;
    }
    if !usual {
        one_by_one::<F, E, M, K>(block, sin, cos);
    }
}

#[inline(always)]
fn at<F, V, const E: usize, const M: usize, const K: usize>(
    token: V::Token,
    block: &Block<'_, F::Scalar, E>,
    sin: &Sines<F::Scalar, K>,
    cos: &Sines<F::Scalar, K>,
    after: usize,
) -> [V; M]
where
    F: Function<E, M, K>,
    V: Vector<F::Scalar>,
{
    let entries: [V; E] = vectors_of(token, block, after);
    let (mut sines, mut cosines) = ([entries[0]; K], [entries[0]; K]);
    let mut angle = 0;
    while angle < K {
        sines[angle] = V::load(token, &sin.0[angle], after);
        cosines[angle] = V::load(token, &cos.0[angle], after);
        angle += 1;
    }
    F::vectors(&entries, &sines, &cosines)
}

/// Computes the sines of a block one after the other, where an angle needs a library.
#[cold]
#[inline(never)]
fn one_by_one<F, const E: usize, const M: usize, const K: usize>(
    block: &Block<'_, F::Scalar, E>,
    sin: &mut Sines<F::Scalar, K>,
    cos: &mut Sines<F::Scalar, K>,
) where
    F: Function<E, M, K>,
{
    for state in 0..BLOCK {
        let entries = block.map(|column| column[state]);
        for (angle, value) in F::angles(&entries).into_iter().enumerate() {
            (sin.0[angle][state], cos.0[angle][state]) = match F::FUSED {
                true => alone::<F::Scalar, Fused>(value),
                false => alone::<F::Scalar, Rounded>(value),
            };
        }
    }
}
