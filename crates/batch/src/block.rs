//! So many states of columns.

use core::array::from_fn;

use crate::Vector;
use crate::vector::BLOCK;

pub(crate) struct Block<'a, T, const A: usize, const N: usize>([[&'a [T; BLOCK]; N]; A]);

impl<'a, T: Copy, const A: usize, const N: usize> Block<'a, T, A, N> {
    /// Returns the block that begins at a state. It ends early where there is none: of
    /// a loop that did not, compilers would make vectors of addresses, which are slower.
    #[inline(always)]
    pub(crate) fn at(arguments: [&'a [&'a [T]; N]; A], begin: usize) -> Option<Self> {
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
    pub(crate) fn vectors<V: Vector<T>>(&self, token: V::Token, after: usize) -> [[V; N]; A] {
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

    pub(crate) fn state(&self, state: usize) -> [[T; N]; A] {
        self.0.map(|argument| argument.map(|column| column[state]))
    }
}

/// Returns a block that ends with a slice, before which its first entry stands: of a state that
/// somebody asked for, no library's slow path is taken that would not be taken anyway.
pub(crate) fn ending<T: Copy>(slice: &[T]) -> [T; BLOCK] {
    from_fn(|at| slice[(at + slice.len()).saturating_sub(BLOCK)])
}
