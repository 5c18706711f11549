//! Work shared out among threads, whose number no result depends on.

use std::cmp::Reverse;
use std::num::NonZero;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;

/// As much as a program's first thread has, since the others run the same code.
const STACK: usize = 8 << 20;

/// Applies a function to each item in threads and keeps the order. Work begins with the last item:
/// the long outputs come last, and none should be left alone at the end.
pub fn each<'t, T: Sync, R: Send>(items: &'t [T], function: impl Fn(&'t T) -> R + Sync) -> Vec<R> {
    let next = AtomicUsize::new(0);
    let (sender, results) = mpsc::channel();
    let work = || {
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            let Some(item) = items.iter().nth_back(index) else {
                break;
            };
            let _ = sender.send((index, function(item)));
        }
    };
    let threads = thread::available_parallelism().map_or(1, NonZero::get);
    thread::scope(|scope| {
        for _ in 1..threads.min(items.len()) {
            let thread = thread::Builder::new().stack_size(STACK);
            if thread.spawn_scoped(scope, work).is_err() {
                break;
            }
        }
        work();
    });
    let mut results: Vec<(usize, R)> = results.try_iter().collect();
    results.sort_by_key(|(index, _)| Reverse(*index));
    results.into_iter().map(|(_, result)| result).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_are_in_the_order_of_their_items() {
        let items: Vec<u64> = (0..100).collect();
        let slow = |&k: &u64| {
            std::hint::black_box((0..k * 1000).sum::<u64>());
            k
        };
        assert_eq!(each(&items, slow), items);
        assert!(each(&[], slow).is_empty());
    }
}
