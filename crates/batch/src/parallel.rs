//! Batches on all cores by rayon: whoever is free takes the next task, the caller too.
//!
//! The caller waits for nobody to begin: as long as the others wake up it computes, and where
//! they never do it has computed all. The results do not depend on who computes them.

extern crate std;

use core::array::from_fn;
use core::mem::take;
use std::sync::Mutex;

use crate::argument::Entries;
use crate::dispatch::entries_in;
use crate::slices::states_of;
use crate::vector::BLOCK;
use crate::{Argument, Function, Unequal, Vectors};

/// The bytes of a task's arguments and results: ten to thirty microseconds, in which a task costs
/// nothing to take, and of which the last ones end at nearly one time.
const TASK: usize = 1 << 19;

/// Less is computed before a thread wakes up, in ten microseconds and more on a virtual machine.
const LEAST: usize = 3 << 20;

/// Runs [`columns`](crate::columns) on all cores.
///
/// # Errors
/// [`Unequal`]; then nothing is computed.
pub fn columns<F, const E: usize, const M: usize, const K: usize, const R: usize>(
    arguments: &[Argument<'_, F::Scalar>],
    results: &mut [&mut [F::Scalar]; M],
) -> Result<(), Unequal>
where
    F: Function<E, M, K>,
    F::Scalar: Send + Sync,
{
    let states = states_of(results)?;
    let entries = Entries::<F::Scalar, E, R>::of(arguments, states)?;
    let vectors = Vectors::widest();
    let Some(task) = task(states, (E + M) * size_of::<F::Scalar>()) else {
        entries_in::<F, E, M, K, R>(vectors, &entries, results);
        return Ok(());
    };
    let results = results.each_mut().map(|column| &mut **column);
    share(
        (0, results),
        |(first, results)| {
            let range = *first..(*first + task).min(states);
            *first = range.end;
            let mut parts = from_fn::<&mut [F::Scalar], M, _>(|_| &mut []);
            for (part, rest) in parts.iter_mut().zip(results) {
                (*part, *rest) = take(rest).split_at_mut(range.len());
            }
            (!range.is_empty()).then(|| (entries.at(range), parts))
        },
        |(entries, mut results)| entries_in::<F, E, M, K, R>(vectors, &entries, &mut results),
    );
    Ok(())
}

/// Returns the states of a task, whole blocks of them; `None` where one thread alone computes all.
fn task(states: usize, bytes: usize) -> Option<usize> {
    let is_much = states.saturating_mul(bytes) >= LEAST && rayon::current_num_threads() > 1;
    is_much.then(|| (TASK / bytes).next_multiple_of(BLOCK))
}

fn share<W: Send, T>(work: W, split: impl Fn(&mut W) -> Option<T> + Sync, run: impl Fn(T) + Sync) {
    let rest = Mutex::new(work);
    // Poisoned where another panicked, which ends all.
    let next = || rest.lock().ok().and_then(|mut rest| split(&mut rest));
    let worker = || {
        while let Some(task) = next() {
            run(task);
        }
    };
    rayon::in_place_scope(|scope| {
        for _ in 1..rayon::current_num_threads() {
            scope.spawn(|_| worker());
        }
        worker();
    });
}
