//! From slices to lanes and back.
//!
//! Loops stand here in place of closures and iterators that take them: all of
//! it must be compiled for the same vectors as the function is, and only what is
//! inlined for certain is.

use crate::{Function, Slice, Unequal};

/// [`states`](crate::states) in L lanes, compiled for what the caller is: for
/// who knows the processor, or chooses by another crate's means.
///
/// # Errors
/// [`Unequal`]; then nothing is computed.
#[inline(always)]
pub fn states_in_lanes<F, const L: usize, const A: usize, const N: usize, const M: usize>(
    arguments: [&[[F::Scalar; N]]; A],
    results: &mut [F::State],
) -> Result<(), Unequal>
where
    F: Function<A, N, M>,
{
    check_states(&arguments, results.len())?;
    run_states::<F, L, A, N, M>(arguments, results);
    Ok(())
}

/// [`columns`](crate::columns) in L lanes, compiled for what the caller is.
///
/// # Errors
/// [`Unequal`]; then nothing is computed.
#[inline(always)]
pub fn columns_in_lanes<F, const L: usize, const A: usize, const N: usize, const M: usize>(
    arguments: [&[&[F::Scalar]; N]; A],
    results: &mut [&mut [F::Scalar]; M],
) -> Result<(), Unequal>
where
    F: Function<A, N, M>,
{
    check_columns(&arguments, results)?;
    run_columns::<F, L, A, N, M>(arguments, results);
    Ok(())
}

/// Whether there is an argument of each for every result.
pub(crate) fn check_states<T, const N: usize>(
    arguments: &[&[[T; N]]],
    states: usize,
) -> Result<(), Unequal> {
    for (index, argument) in (1..).zip(arguments) {
        Unequal::check(Slice::Argument(index), argument.len(), states)?;
    }
    Ok(())
}

/// Whether all columns are of one length.
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

/// All slices are of one length.
#[inline(always)]
pub(crate) fn run_states<F, const L: usize, const A: usize, const N: usize, const M: usize>(
    arguments: [&[[F::Scalar; N]]; A],
    results: &mut [F::State],
) where
    F: Function<A, N, M>,
{
    let mut lanes = [[[F::Scalar::default(); L]; N]; A];
    let mut start = 0;
    for results in results.chunks_mut(L) {
        let count = results.len();
        for (lanes, argument) in lanes.iter_mut().zip(arguments) {
            if let Some(states) = argument.get(start..start + count) {
                load(lanes, states);
            }
        }
        let found = F::lanes(&lanes);
        for (l, result) in results.iter_mut().enumerate() {
            *result = F::state(&found, l);
        }
        start += L;
    }
}

/// States into lanes. If they are fewer, the first of them is in the others too:
/// a state that somebody asked for, of which no library's slow path is taken
/// that would not be taken anyway.
#[inline(always)]
fn load<T: Copy, const L: usize, const N: usize>(lanes: &mut [[T; L]; N], states: &[[T; N]]) {
    match states.first_chunk::<L>() {
        Some(states) => {
            for (l, state) in states.iter().enumerate() {
                for (lane, value) in lanes.iter_mut().zip(state) {
                    lane[l] = *value;
                }
            }
        }
        None => {
            for (i, lane) in lanes.iter_mut().enumerate() {
                for (l, place) in lane.iter_mut().enumerate() {
                    if let Some(state) = states.get(l).or(states.first()) {
                        *place = state[i];
                    }
                }
            }
        }
    }
}

/// All columns are of one length.
#[inline(always)]
pub(crate) fn run_columns<F, const L: usize, const A: usize, const N: usize, const M: usize>(
    arguments: [&[&[F::Scalar]; N]; A],
    results: &mut [&mut [F::Scalar]; M],
) where
    F: Function<A, N, M>,
{
    let states = results.first().map_or(0, |first| first.len());
    let mut lanes = [[[F::Scalar::default(); L]; N]; A];
    let mut start = 0;
    while start < states {
        for (lanes, argument) in lanes.iter_mut().zip(arguments) {
            for (lane, column) in lanes.iter_mut().zip(argument) {
                if let Some(rest) = column.get(start..) {
                    fill(lane, rest);
                }
            }
        }
        let found = F::columns(&F::lanes(&lanes));
        for (column, found) in results.iter_mut().zip(&found) {
            if let Some(rest) = column.get_mut(start..) {
                match rest.first_chunk_mut::<L>() {
                    Some(place) => *place = *found,
                    None => {
                        for (place, value) in rest.iter_mut().zip(found) {
                            *place = *value;
                        }
                    }
                }
            }
        }
        start += L;
    }
}

/// What a column begins with; if it is too short, its first number in the other
/// lanes.
#[inline(always)]
fn fill<T: Copy, const L: usize>(lane: &mut [T; L], rest: &[T]) {
    match rest.first_chunk::<L>() {
        Some(values) => *lane = *values,
        None => {
            for (l, place) in lane.iter_mut().enumerate() {
                if let Some(value) = rest.get(l).or(rest.first()) {
                    *place = *value;
                }
            }
        }
    }
}
