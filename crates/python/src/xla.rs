//! Calls from compiled programs of JAX, by XLA's foreign-function interface: the safe part.

use std::sync::{Arc, Mutex, PoisonError};

use dalembert_jit::{Arm, Function, Place, Real};

/// XLA keeps programs for as long as it likes, so nothing is taken out.
static KNOWN: Mutex<Vec<(Arc<Arm>, usize)>> = Mutex::new(Vec::new());

pub(crate) fn register(arm: &Arc<Arm>, place: usize) -> u64 {
    let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    let same = |(other, at): &(Arc<Arm>, usize)| Arc::ptr_eq(arm, other) && *at == place;
    let number = known.iter().position(same).unwrap_or_else(|| {
        known.push((arm.clone(), place));
        known.len() - 1
    });
    number as u64
}

pub(crate) fn find(number: u64) -> Option<(Arc<Arm>, usize)> {
    let known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    known.get(usize::try_from(number).ok()?).cloned()
}

/// Computes the results of as many states as the arguments have, row by row.
pub(crate) fn run<T: Real>(
    function: &Function,
    arguments: &[&[T]],
    results: Vec<&mut [T]>,
) -> Result<(), String> {
    let native = function.native();
    let signature = native.signature();
    let lengths: Vec<usize> = signature.arguments.iter().map(|&(_, len)| len).collect();
    let found = [arguments.len(), results.len()];
    let expected = [lengths.len(), signature.results.len()];
    if found != expected {
        let expected = format!("expected {expected:?} arguments and results");
        return Err(format!("{expected}, found {found:?}"));
    }
    let states = match (arguments.first(), lengths.first()) {
        (Some(first), Some(length)) => first.len() / length,
        _ => 0,
    };
    let whole = |(count, length): (usize, &usize)| count == states * length;
    let mut read = arguments.iter().map(|data| data.len()).zip(&lengths);
    let written = results.iter().map(|data| data.len());
    let name = function.name();
    if !(read.all(whole) && written.zip(&signature.results).all(whole)) {
        let expected = format!("{lengths:?} numbers of {states} states");
        return Err(format!("{name}: expected {expected}"));
    }
    let place = |&length: &usize| Place::rows(length);
    let rows = arguments.iter().copied().zip(lengths.iter().map(place));
    let out = results.into_iter().zip(signature.results.iter().map(place));
    let (rows, mut out): (Vec<_>, Vec<_>) = (rows.collect(), out.collect());
    let done = native.call_rows(&rows, &mut out, states, 1);
    done.map_err(|error| format!("{name}: {error}"))
}
