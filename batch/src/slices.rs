//! From slices to lanes and back.
//!
//! Loops over indices stand here in place of closures and iterators: all of it must be
//! compiled for the same vectors as the function is, and only what is inlined for
//! certain is. (`zip` is not, without link-time optimisation of a crate's parts.)

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
    while let Some(results) = results.get_mut(start..).filter(|rest| !rest.is_empty()) {
        let count = results.len().min(L);
        let mut argument = 0;
        while argument < A {
            if let Some(states) = arguments[argument].get(start..start + count) {
                load(&mut lanes[argument], states);
            }
            argument += 1;
        }
        let found = F::lanes(&lanes);
        let mut lane = 0;
        while lane < count {
            results[lane] = F::state(&found, lane);
            lane += 1;
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
            let mut lane = 0;
            while lane < L {
                let mut entry = 0;
                while entry < N {
                    lanes[entry][lane] = states[lane][entry];
                    entry += 1;
                }
                lane += 1;
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
        let mut argument = 0;
        while argument < A {
            let mut entry = 0;
            while entry < N {
                if let Some(rest) = arguments[argument][entry].get(start..) {
                    fill(&mut lanes[argument][entry], rest);
                }
                entry += 1;
            }
            argument += 1;
        }
        let found = F::columns(&F::lanes(&lanes));
        let mut result = 0;
        while result < M {
            if let Some(rest) = results[result].get_mut(start..) {
                match rest.first_chunk_mut::<L>() {
                    Some(place) => *place = found[result],
                    None => rest.copy_from_slice(&found[result][..rest.len()]),
                }
            }
            result += 1;
        }
        start += L;
    }
}

/// Copies the beginning of a column; if it is too short, its first number fills the other
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
