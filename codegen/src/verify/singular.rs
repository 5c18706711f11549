//! Decides exactly whether D has an inverse in almost every state.
//!
//! D of the joints that move is factorised from the hand inward at random
//! points, as proofs draw them. A pivot that is zero at every one of them is
//! zero in every state but for the chance of a miss, and says which joint
//! moves no inertia while the joints beyond it are free.

use dalembert_model::equations::factor::{Factor, submatrix};
use dalembert_model::equations::forward::free;
use dalembert_model::scalar::Divide;

use super::exact::{posed, reference_formulation};
use super::points::{POINTS, Point, points, written};
use crate::function::Function;
use crate::scene::SceneRobot;

/// Returns the joint nearest to the hand that moves no inertia in any state; none if
/// D has an inverse almost everywhere.
pub(crate) fn without_inertia(scene_robot: &SceneRobot, function: Function) -> Option<usize> {
    let mut found = None;
    let statement = ["inertia", &written(scene_robot)];
    // A point without values tells nothing; without any that has them the proof will say so.
    let pivots = points(&statement).filter_map(|point| zero_pivot(scene_robot, function, &point));
    for joint in pivots.take(POINTS) {
        found = Some(joint?);
    }
    found
}

/// Returns the joint of the first zero pivot from the hand inward, if there is one; nothing at a
/// point without values.
fn zero_pivot(
    scene_robot: &SceneRobot,
    function: Function,
    point: &Point,
) -> Option<Option<usize>> {
    let posed = posed(scene_robot, function, point);
    let (arm, motion) = (&posed.arm, &posed.motion);
    let free = free(&motion.moves);
    let d = reference_formulation(scene_robot).gathered_inertia(arm, &arm.at(&motion.q));
    let factor = Factor::new(&submatrix(&d, &free));
    for (pivot, row) in factor.pivots().iter().zip(&free).rev() {
        if !pivot.value()?.divides() {
            return Some(Some(scene_robot.robot().mover_of(*row)));
        }
    }
    Some(None)
}
