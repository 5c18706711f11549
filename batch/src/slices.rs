//! From slices to lanes and back.
//!
//! Loops over indices stand here in place of closures and iterators: all of it must be
//! compiled for the same vectors as the function is, and only what is inlined for
//! certain is. (`zip` is not, without link-time optimisation of a crate's parts.)

use core::array::from_fn;

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

/// Lanes of which no vector straddles two lines of the cache.
#[repr(align(64))]
struct Aligned<T>(T);

/// Runs a function over columns of one length.
///
/// Chunks are of L states each. The last one begins where it ends with the columns, and
/// computes some states once more, to the same bits: what is left over needs no second
/// text of the function. Fewer than L states are computed in columns of their own.
#[inline(always)]
pub(crate) fn run_columns<F, const L: usize, const A: usize, const N: usize, const M: usize>(
    arguments: [&[&[F::Scalar]; N]; A],
    results: &mut [&mut [F::Scalar]; M],
) where
    F: Function<A, N, M>,
{
    let states = results.first().map_or(0, |first| first.len());
    let few: [[[F::Scalar; L]; N]; A] =
        from_fn(|argument| from_fn(|entry| filled(arguments[argument][entry])));
    let own: [[&[F::Scalar]; N]; A] =
        from_fn(|argument| from_fn(|entry| &few[argument][entry][..]));
    let mut found = [[F::Scalar::default(); L]; M];
    let is_few = states < L;
    let (arguments, mut columns, count) = match is_few {
        true => {
            let places = found.each_mut().map(|place| &mut place[..]);
            (own.each_ref(), places, L.min(states * L))
        }
        false => {
            let places = results.each_mut().map(|place| &mut **place);
            (arguments, places, states)
        }
    };
    let mut start = 0;
    while start < count {
        let at = if start + L <= count { start } else { count - L };
        let mut lanes = Aligned([[[F::Scalar::default(); L]; N]; A]);
        let mut argument = 0;
        while argument < A {
            let mut entry = 0;
            while entry < N {
                let rest = arguments[argument][entry].get(at..);
                if let Some(values) = rest.and_then(|rest| rest.first_chunk::<L>()) {
                    lanes.0[argument][entry] = *values;
                }
                entry += 1;
            }
            argument += 1;
        }
        let chunk = F::columns(&F::lanes(&lanes.0));
        let mut result = 0;
        while result < M {
            let rest = columns[result].get_mut(at..);
            if let Some(place) = rest.and_then(|rest| rest.first_chunk_mut::<L>()) {
                *place = chunk[result];
            }
            result += 1;
        }
        start += L;
    }
    if is_few {
        for (result, found) in results.iter_mut().zip(&found) {
            result.copy_from_slice(&found[..states]);
        }
    }
}

/// Returns the beginning of a column; if it is too short, its first number fills the other
/// lanes.
fn filled<T: Copy + Default, const L: usize>(column: &[T]) -> [T; L] {
    from_fn(|lane| {
        let value = column.get(lane).or(column.first());
        value.copied().unwrap_or_default()
    })
}
