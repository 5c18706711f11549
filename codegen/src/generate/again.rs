//! Functions that are searched for again: after an edit, and after an early end.

use dalembert_model::robot::Robot;

use super::{
    GenerateError, GeneratedCode, GeneratedFunction, Job, Outcome, Request, functions, generate,
};
use crate::program::ScalarType;
use crate::search::{Effort, price};
use crate::watch::Watch;

/// Generates as [`generate`] does; where the plan is of the robot or the scene before an
/// edit, searches without it, and warns with the command that renews it. Messages call the
/// robot file `shown`.
///
/// # Errors
/// Those of [`generate`], except for a plan that no longer fits.
pub fn generate_anew(robot: &Robot, request: &Request, shown: &str) -> Outcome<GeneratedCode> {
    let what = match generate(robot, request) {
        Err(GenerateError::Stale(what, _)) => what,
        other => return other,
    };
    let mut without = request.clone();
    without.plan = None;
    let mut generated = generate(robot, &without)?;
    let scene = request.scene.as_ref();
    let scene = scene.map(|scene| format!("--scene {} ", scene.name));
    generated.warnings.push(format!(
        "the plan beside {shown} no longer fits {what}, which was edited since: a search took its \
         place; `dalembert generate {shown} {}--effort thorough --save-plan` renews it",
        scene.unwrap_or_default()
    ));
    Ok(generated)
}

/// After an early end, keeps the quick search's function wherever it is cheaper, so that an early
/// end is never worse than no patience.
pub(super) fn no_dearer_than_quick(
    job: &Job<'_>,
    generated: &mut [GeneratedFunction],
    scalars: &[ScalarType],
) {
    let quick_request = Request {
        effort: Effort::Quick,
        watch: Watch::default(),
        ..job.request.clone()
    };
    let Ok((quick, theirs)) = functions(&job.with(&quick_request)) else {
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
