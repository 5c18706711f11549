//! A search that was ended early: what it has until then may be less than what
//! the quick search gives, which takes seconds and which whoever wants an end
//! could have had at once. So that one is run as well, function by function the
//! cheaper program stays, and an early end is never worse than no patience.

use super::{GeneratedFunction, Job, Request, functions};
use crate::program::ScalarType;
use crate::search::{Effort, price};
use crate::watch::Watch;

/// Puts the quick search's functions in the place of dearer ones.
pub(super) fn no_dearer_than_quick(
    job: &Job<'_>,
    generated: &mut [GeneratedFunction],
    scalars: &[ScalarType],
) {
    let quick = Request {
        effort: Effort::Quick,
        watch: Watch::default(),
        ..job.request.clone()
    };
    // Where it finds nothing, what is there already stays.
    let Ok((quick, theirs)) = functions(&job.with(&quick)) else {
        return;
    };
    if theirs != scalars {
        // Its bounds are coarser: it may have needed a wider scalar.
        return;
    }
    for (function, quick) in generated.iter_mut().zip(quick) {
        if price(&quick.program.counts()) < price(&function.program.counts()) {
            *function = quick;
        }
    }
}
