//! Decides exactly whether D has an inverse in almost every state.
//!
//! D of the joints that move is factorised from the hand inward at random points, as proofs draw
//! them. A pivot that is zero at every one of them is zero in every state but for the chance of a
//! miss, and says which joint moves no inertia while the joints beyond it are free.

use dalembert_model::equations::factor::{Factor, submatrix};
use dalembert_model::equations::forward::free;
use dalembert_model::scalar::Divide;

use super::exact::reference_formulation;
use super::points::{POINTS, Point, points, written};
use crate::scalar::AnyLeaves;
use crate::setup::Task;

/// The joint nearest to the hand; none if D has an inverse almost everywhere.
pub(crate) fn without_inertia(task: Task<'_>) -> Option<usize> {
    let statement = ["inertia", &written(task.setup)];
    // A point without values tells nothing; without any that has them the proof will say so.
    let pivots = points(&statement, POINTS).filter_map(|point| zero_pivot(task, &point));
    let joints: Option<Vec<usize>> = pivots.take(POINTS).collect();
    joints?.pop()
}

/// Counts from the hand inward; the outer option is none at a point without values.
fn zero_pivot(task: Task<'_>, point: &Point) -> Option<Option<usize>> {
    let posed = task.posed(&AnyLeaves(point));
    let (arm, motion) = (&posed.arm, &posed.motion);
    let free = free(&motion.moves);
    let d = reference_formulation(task.setup).gathered_inertia(arm, &arm.at(&motion.q));
    let factor = Factor::new(&submatrix(&d, &free));
    for (pivot, row) in factor.pivots().iter().zip(&free).rev() {
        if !pivot.value()?.divides() {
            return Some(Some(task.setup.robot().mover_of(*row)));
        }
    }
    Some(None)
}
