//! From slices to vectors and back.
//!
//! Loops over indices stand here in place of closures and iterators: all of it must be
//! compiled for the same vectors as the function is, and only what is inlined for
//! certain is. (`zip` is not, without link-time optimisation of a crate's parts.)

use core::array::from_fn;
use core::hint::black_box;

use dalembert_sines::text::alone;

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

/// The sines or cosines of a block.
type Sines<T, const K: usize> = Aligned<[[T; BLOCK]; K]>;

/// Runs a function over columns of one length.
#[inline(always)]
pub(crate) fn run_columns<F, V, const A: usize, const N: usize, const M: usize, const K: usize>(
    token: V::Token,
    arguments: [&[&[F::Scalar]; N]; A],
    results: &mut [&mut [F::Scalar]; M],
) where
    F: Function<A, N, M, K>,
    V: Vector<F::Scalar>,
{
    let states = results.first().map_or(0, |first| first.len());
    let zeros = [F::Scalar::default(); BLOCK];
    let (mut sin, mut cos) = (Aligned([zeros; K]), Aligned([zeros; K]));
    // What is left over after whole blocks, and its results.
    let (mut rest, mut found) = (Aligned([[zeros; N]; A]), Aligned([zeros; M]));
    let mut start = 0;
    while start < states {
        // Hidden, or compilers would write the function twice: for whole blocks and for others.
        let count = black_box(BLOCK.min(states - start));
        if count < BLOCK {
            rest.0 = arguments.map(|argument| argument.map(|column| filled(&column[start..])));
        }
        let mut block = rest.0.each_ref().map(|argument| argument.each_ref());
        let mut argument = 0;
        while argument < A {
            let mut entry = 0;
            while entry < N {
                let column = arguments[argument][entry].get(start..);
                if let Some(whole) = column.and_then(|column| column.first_chunk()) {
                    block[argument][entry] = whole;
                }
                entry += 1;
            }
            argument += 1;
        }
        let mut places = found.0.each_mut();
        if count == BLOCK {
            for (place, column) in places.iter_mut().zip(results.iter_mut()) {
                let column = column.get_mut(start..);
                if let Some(whole) = column.and_then(|column| column.first_chunk_mut()) {
                    *place = whole;
                }
            }
        }
        run_block::<F, V, A, N, M, K>(token, &block, &mut sin, &mut cos, &mut places, count);
        if count < BLOCK {
            for (column, found) in results.iter_mut().zip(&found.0) {
                column[start..].copy_from_slice(&found[..count]);
            }
        }
        start += BLOCK;
    }
}

/// Computes the states of slices, which are all of one length.
#[inline(always)]
pub(crate) fn run_states<F, V, const A: usize, const N: usize, const M: usize, const K: usize>(
    token: V::Token,
    arguments: [&[[F::Scalar; N]]; A],
    results: &mut [F::State],
) where
    F: Function<A, N, M, K>,
    V: Vector<F::Scalar>,
{
    let zeros = [F::Scalar::default(); BLOCK];
    let mut columns = Aligned([[zeros; N]; A]);
    let (mut sin, mut cos) = (Aligned([zeros; K]), Aligned([zeros; K]));
    let mut found = Aligned([zeros; M]);
    let mut start = 0;
    while let Some(results) = results.get_mut(start..).filter(|rest| !rest.is_empty()) {
        let count = results.len().min(BLOCK);
        let mut argument = 0;
        while argument < A {
            if let Some(states) = arguments[argument].get(start..start + count) {
                match states.first_chunk() {
                    Some(states) => transpose(states, &mut columns.0[argument]),
                    None => transpose(&filled(states), &mut columns.0[argument]),
                }
            }
            argument += 1;
        }
        let block = columns.0.each_ref().map(|argument| argument.each_ref());
        let mut places = found.0.each_mut();
        run_block::<F, V, A, N, M, K>(token, &block, &mut sin, &mut cos, &mut places, count);
        write_states::<F, A, N, M, K>(&found.0, &mut results[..count]);
        start += BLOCK;
    }
}

/// Puts a block of states in columns. It is compiled for the target as it is: with wider vectors,
/// compilers gather, which takes three times as long.
#[inline(never)]
fn transpose<T: Copy, const N: usize>(states: &[[T; N]; BLOCK], columns: &mut [[T; BLOCK]; N]) {
    let mut state = 0;
    while state < BLOCK {
        let mut entry = 0;
        while entry < N {
            columns[entry][state] = states[state][entry];
            entry += 1;
        }
        state += 1;
    }
}

/// Puts results in their states; compiled as [`transpose`] is.
#[inline(never)]
fn write_states<F, const A: usize, const N: usize, const M: usize, const K: usize>(
    found: &[[F::Scalar; BLOCK]; M],
    results: &mut [F::State],
) where
    F: Function<A, N, M, K>,
{
    for (state, result) in results.iter_mut().enumerate().take(BLOCK) {
        let mut numbers = [F::Scalar::default(); M];
        let mut number = 0;
        while number < M {
            numbers[number] = found[number][state];
            number += 1;
        }
        *result = F::state(numbers);
    }
}

/// Runs a function over so many states of a block, and over the others of the last vector.
#[inline(always)]
fn run_block<F, V, const A: usize, const N: usize, const M: usize, const K: usize>(
    token: V::Token,
    block: &[[&[F::Scalar; BLOCK]; N]; A],
    sin: &mut Sines<F::Scalar, K>,
    cos: &mut Sines<F::Scalar, K>,
    results: &mut [&mut [F::Scalar; BLOCK]; M],
    states: usize,
) where
    F: Function<A, N, M, K>,
    V: Vector<F::Scalar>,
{
    // Said in such a way that no compiler doubts whether a block has so many.
    let vectors = states.div_ceil(V::LANES).min(BLOCK / V::LANES);
    let mut usual = true;
    let mut after = 0;
    while K > 0 && after < vectors {
        let angles = F::angles(&loaded::<F::Scalar, V, A, N>(token, block, after));
        let (sines, cosines, all) = V::sincos(&angles);
        let mut angle = 0;
        while angle < K {
            sines[angle].store(&mut sin.0[angle], after);
            cosines[angle].store(&mut cos.0[angle], after);
            angle += 1;
        }
        usual &= all;
        after += 1;
    }
    if !usual {
        one_by_one::<F, A, N, M, K>(block, sin, cos);
    }
    let mut after = 0;
    while after < vectors {
        let arguments = loaded::<F::Scalar, V, A, N>(token, block, after);
        let (mut sines, mut cosines) = ([arguments[0][0]; K], [arguments[0][0]; K]);
        let mut angle = 0;
        while angle < K {
            sines[angle] = V::load(token, &sin.0[angle], after);
            cosines[angle] = V::load(token, &cos.0[angle], after);
            angle += 1;
        }
        let found = F::vectors(&arguments, &sines, &cosines);
        let mut result = 0;
        while result < M {
            found[result].store(results[result], after);
            result += 1;
        }
        after += 1;
    }
}

/// Returns the vectors of all columns that stand after so many others.
#[inline(always)]
fn loaded<T, V: Vector<T>, const A: usize, const N: usize>(
    token: V::Token,
    columns: &[[&[T; BLOCK]; N]; A],
    after: usize,
) -> [[V; N]; A] {
    let mut vectors = [[V::load(token, columns[0][0], after); N]; A];
    let mut argument = 0;
    while argument < A {
        let mut entry = 0;
        while entry < N {
            vectors[argument][entry] = V::load(token, columns[argument][entry], after);
            entry += 1;
        }
        argument += 1;
    }
    vectors
}

/// Computes the sines of a block one after the other, where an angle needs a library.
#[cold]
#[inline(never)]
fn one_by_one<F, const A: usize, const N: usize, const M: usize, const K: usize>(
    block: &[[&[F::Scalar; BLOCK]; N]; A],
    sin: &mut Sines<F::Scalar, K>,
    cos: &mut Sines<F::Scalar, K>,
) where
    F: Function<A, N, M, K>,
{
    for state in 0..BLOCK {
        let arguments = block.map(|argument| argument.map(|column| column[state]));
        for (angle, value) in F::angles(&arguments).into_iter().enumerate() {
            (sin.0[angle][state], cos.0[angle][state]) = alone(value);
        }
    }
}

/// Returns a block with the beginning of a slice; if that is short, its first entry fills the
/// other places: of a state that somebody asked for, no library's slow path is taken that would
/// not be taken anyway.
fn filled<T: Copy>(slice: &[T]) -> [T; BLOCK] {
    from_fn(|at| *slice.get(at).unwrap_or(&slice[0]))
}
