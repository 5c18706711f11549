//! Batches on all cores by rayon; each half of the states goes to a free thread.
//!
//! What comes out does not depend on who computes it.

use core::array::from_fn;

use crate::slices::{check_columns, check_states};
use crate::vector::BLOCK;
use crate::{Function, Unequal};

/// The least numbers, arguments and results, of a task. To hand one to another thread and to wait
/// for it takes some ten microseconds, on a virtual machine up to a hundred, and must be a part of
/// its work that costs less than the other thread saves: a million numbers take 100 to 400.
const TASK: usize = 1 << 20;

/// Runs [`states`](crate::states) on all cores.
///
/// # Errors
/// [`Unequal`]; then nothing is computed.
pub fn states<F, const A: usize, const N: usize, const M: usize, const K: usize>(
    arguments: [&[[F::Scalar; N]]; A],
    results: &mut [F::State],
) -> Result<(), Unequal>
where
    F: Function<A, N, M, K>,
    F::Scalar: Sync,
    F::State: Send,
{
    check_states(&arguments, results.len())?;
    let count = results.len();
    if is_one_task(count, A * N + M) {
        return crate::states::<F, A, N, M, K>(arguments, results);
    }
    let half = middle(count);
    let (left, right) = results.split_at_mut(half);
    let (first, second) = (
        arguments.map(|argument| argument.split_at(half).0),
        arguments.map(|argument| argument.split_at(half).1),
    );
    let (left, right) = rayon::join(
        || states::<F, A, N, M, K>(first, left),
        || states::<F, A, N, M, K>(second, right),
    );
    left.and(right)
}

/// Runs [`columns`](crate::columns) on all cores.
///
/// # Errors
/// [`Unequal`]; then nothing is computed.
pub fn columns<F, const A: usize, const N: usize, const M: usize, const K: usize>(
    arguments: [&[&[F::Scalar]; N]; A],
    results: &mut [&mut [F::Scalar]; M],
) -> Result<(), Unequal>
where
    F: Function<A, N, M, K>,
    F::Scalar: Send + Sync,
{
    let count = check_columns(&arguments, results)?;
    if is_one_task(count, A * N + M) {
        return crate::columns::<F, A, N, M, K>(arguments, results);
    }
    let half = middle(count);
    let first = arguments.map(|columns| columns.map(|column| column.split_at(half).0));
    let second = arguments.map(|columns| columns.map(|column| column.split_at(half).1));
    let halves = results.each_mut().map(|column| column.split_at_mut(half));
    let (mut left, mut right) = (
        from_fn::<&mut [F::Scalar], M, _>(|_| &mut []),
        from_fn::<&mut [F::Scalar], M, _>(|_| &mut []),
    );
    for (((a, b), left), right) in halves.into_iter().zip(&mut left).zip(&mut right) {
        (*left, *right) = (a, b);
    }
    let (left, right) = rayon::join(
        || columns::<F, A, N, M, K>(first.each_ref(), &mut left),
        || columns::<F, A, N, M, K>(second.each_ref(), &mut right),
    );
    left.and(right)
}

/// Returns whether so many states of so many numbers are not worth a second thread, or there is
/// none.
fn is_one_task(count: usize, numbers: usize) -> bool {
    count.saturating_mul(numbers) < 2 * TASK || rayon::current_num_threads() == 1
}

/// Returns the middle of so many states, a whole number of blocks.
fn middle(count: usize) -> usize {
    (count / 2).next_multiple_of(BLOCK)
}
