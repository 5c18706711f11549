//! So many states of slices, in columns or in rows.

use core::array::from_fn;

use crate::Vector;
use crate::vector::BLOCK;

/// Returns the block of each column that begins at a state. It ends early where there is none: of
/// a loop that did not, compilers would make vectors of addresses, which are slower.
#[inline(always)]
pub(crate) fn columns_of<'a, T, const A: usize, const N: usize>(
    arguments: [&'a [&'a [T]; N]; A],
    begin: usize,
) -> Option<[[&'a [T; BLOCK]; N]; A]> {
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
    Some(block)
}

/// Returns the block of each argument that begins at a state.
#[inline(always)]
pub(crate) fn rows_of<T, const A: usize, const N: usize>(
    arguments: [&[[T; N]]; A],
    begin: usize,
) -> Option<[&[[T; N]; BLOCK]; A]> {
    let first = arguments.first()?.get(begin..)?.first_chunk()?;
    let mut rows = [first; A];
    let mut argument = 0;
    while argument < A {
        rows[argument] = arguments[argument].get(begin..)?.first_chunk()?;
        argument += 1;
    }
    Some(rows)
}

/// A block of states.
pub(crate) trait Block<T, V: Vector<T>, const A: usize, const N: usize> {
    /// Returns the vectors of all arguments that stand after so many others.
    fn vectors(&self, token: V::Token, after: usize) -> [[V; N]; A];

    /// Returns the arguments of a state.
    fn state(&self, state: usize) -> [[T; N]; A];
}

/// Numbers in columns.
pub(crate) struct InColumns<'a, T, const A: usize, const N: usize>(
    pub(crate) [[&'a [T; BLOCK]; N]; A],
);

/// Numbers in rows.
pub(crate) struct InRows<'a, T, const A: usize, const N: usize>(
    pub(crate) [&'a [[T; N]; BLOCK]; A],
);

impl<T: Copy, V: Vector<T>, const A: usize, const N: usize> Block<T, V, A, N>
    for InColumns<'_, T, A, N>
{
    #[inline(always)]
    fn vectors(&self, token: V::Token, after: usize) -> [[V; N]; A] {
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

impl<T: Copy + Default, V: Vector<T>, const A: usize, const N: usize> Block<T, V, A, N>
    for InRows<'_, T, A, N>
{
    #[inline(always)]
    fn vectors(&self, token: V::Token, after: usize) -> [[V; N]; A] {
        let mut vectors = [V::columns(token, lanes_of::<T, V, N>(self.0[0], after)); A];
        let mut argument = 1;
        while argument < A {
            vectors[argument] = V::columns(token, lanes_of::<T, V, N>(self.0[argument], after));
            argument += 1;
        }
        vectors
    }

    fn state(&self, state: usize) -> [[T; N]; A] {
        self.0.map(|rows| rows[state])
    }
}

/// Returns the rows of the vector that stands after so many others.
#[inline(always)]
fn lanes_of<T, V: Vector<T>, const N: usize>(rows: &[[T; N]; BLOCK], after: usize) -> &[[T; N]] {
    match rows.get(after * V::LANES..(after + 1) * V::LANES) {
        Some(lanes) => lanes,
        None => rows,
    }
}

/// Returns a block that ends with a slice, before which its first entry stands: of a state that
/// somebody asked for, no library's slow path is taken that would not be taken anyway.
pub(crate) fn ending<T: Copy>(slice: &[T]) -> [T; BLOCK] {
    from_fn(|at| slice[(at + slice.len()).saturating_sub(BLOCK)])
}
