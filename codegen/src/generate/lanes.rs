//! The choice between limbs as lanes and limbs apart, and the requests that lanes cannot meet.

use super::Job;
use crate::dag::Dag;
use crate::function::Function;
use crate::language::Language;
use crate::limbs::{LimbLayout, is_traced, price, side_by_side};
use crate::program::Program;
use crate::search::cost;
use crate::seeds::Start;

/// Returns why limbs of a request can be no lanes, and the fix; none if they can.
pub(super) fn refusal(job: &Job<'_>) -> Option<[&'static str; 2]> {
    let request = job.request;
    Some(match request.language {
        Language::Cuda => [
            "on a GPU the vectors are over states, not limbs",
            "leave `limbs` out, or generate Rust or C",
        ],
        _ if request.batch => [
            "a batch has vectors over states, not limbs",
            "leave `batch` or `limbs` out, or generate two files",
        ],
        _ if job.tolerance().is_some() => [
            "what a tolerance leaves out differs from limb to limb",
            "leave `limbs` out, or take a scene without a tolerance",
        ],
        _ if request.start != Start::Auto => [
            "a formulation alone is used unchanged, without lanes",
            "leave `formulation` or `limbs` out",
        ],
        _ => return None,
    })
}

pub(super) fn may_be_lanes(job: &Job<'_>) -> bool {
    job.request.limbs != LimbLayout::Apart && refusal(job).is_none()
}

/// True unless a plan keeps limbs apart that are asked for as lanes.
pub(super) fn admits(job: &Job<'_>, function: Function, planned: &Program) -> bool {
    let is_asked = job.request.limbs == LimbLayout::Lanes;
    !is_asked || !planned.loops.is_empty() || !is_traced(job.setup.task(function))
}

/// Returns the program of a function whose limbs are lanes, if that is asked for, or if nothing is
/// and it is cheaper than the program whose limbs are apart.
pub(super) fn chosen(
    job: &Job<'_>,
    function: Function,
    apart: &Program,
    accepts: impl Fn(&Dag) -> bool,
) -> Option<Program> {
    let request = job.request;
    if !may_be_lanes(job) {
        return None;
    }
    let lanes = side_by_side(job.setup.task(function), request.effort)?;
    let is_cheaper = price(&lanes) < cost(&apart.dag);
    let is_asked = request.limbs == LimbLayout::Lanes;
    ((is_asked || is_cheaper) && !lanes.loops.is_empty() && accepts(&lanes.dag)).then_some(lanes)
}
