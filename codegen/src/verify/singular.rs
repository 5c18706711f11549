//! Decides exactly whether D has an inverse in almost every state.
//!
//! D of the joints that move is factorised from the hand inward at random
//! points, as proofs draw them. A pivot that is zero at every one of them is
//! zero in every state but for the chance of a miss, and says which joint
//! moves no inertia while the joints beyond it are free.

use dalembert_model::equations::Formulation;
use dalembert_model::equations::factor::{Factor, submatrix};
use dalembert_model::equations::forward::free;
use dalembert_model::number::Exact;
use dalembert_model::scalar::record::Recording;

use super::challenge::{Point, Transcript};
use super::exact::{MAX_DRAWS, PRIMES, WRITTEN_LIMIT};
use crate::function::Function;
use crate::program::Input;
use crate::scene::SceneRobot;

/// Returns the joint nearest to the hand that moves no inertia in any state; none if
/// D has an inverse almost everywhere.
pub(crate) fn without_inertia(scene_robot: &SceneRobot, function: Function) -> Option<usize> {
    let mut transcript = Transcript::new("inertia");
    transcript.scene_robot(scene_robot);
    let challenge = transcript.seal();
    let pivots = pivots(scene_robot, function);
    let mut drawn = (0..MAX_DRAWS).filter_map(|index| challenge.draw(index));
    let mut found = None;
    let mut seen = 0;
    while seen < PRIMES {
        // An unfit prime tells nothing; without fit ones the proof will say so.
        match zero_pivot(&pivots, &drawn.next()?) {
            None => continue,
            Some(None) => return None,
            Some(joint) => found = joint,
        }
        seen += 1;
    }
    found
}

/// The pivots of D over the joints that move, as formulas; the hand's first.
struct Pivots {
    joints: Vec<usize>,
    values: Recording<Input, Exact>,
}

fn pivots(scene_robot: &SceneRobot, function: Function) -> Pivots {
    let mut joints = Vec::new();
    let values = scene_robot.record(function, |posed, _| {
        let (arm, motion) = (&posed.arm, &posed.motion);
        let formulation = match arm.links.len() <= WRITTEN_LIMIT {
            true => Formulation::LagrangeEuler,
            false => Formulation::NewtonEulerLink,
        };
        let free = free(&motion.moves);
        let d = formulation.gathered_inertia(arm, &arm.at(&motion.q));
        let factor = Factor::new(&submatrix(&d, &free));
        let mover = |row| scene_robot.robot().mover_of(row);
        joints = free.into_iter().rev().map(mover).collect();
        factor.pivots().iter().rev().cloned().collect()
    });
    Pivots { joints, values }
}

/// Returns the first zero pivot's joint, if there is one; nothing at an unfit point.
fn zero_pivot(pivots: &Pivots, point: &Point) -> Option<Option<usize>> {
    let constant = |value: &Exact| point.constant(value);
    let values = pivots
        .values
        .run(|input: &Input| point.input(*input), constant)?;
    for (pivot, &joint) in values.iter().zip(&pivots.joints) {
        if pivot.value(point.prime())? == 0 {
            return Some(Some(joint));
        }
    }
    Some(None)
}
