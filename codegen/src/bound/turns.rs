//! Joints that turn without limits.

use dalembert_model::robot::{JointKind, Robot};

use super::input_box::InputBox;
use crate::interval::Interval;
use crate::program::ScalarType;
use crate::sincos::stated;

/// Returns whether a joint may stand anywhere, however many turns: it has no limits.
/// Everything reads its sine and cosine, so that what holds over one turn
/// holds wherever those two are good.
pub(crate) fn turns_freely(robot: &Robot, joint: usize) -> bool {
    robot
        .joints
        .get(joint)
        .is_some_and(|joint| joint.kind == JointKind::Revolute && joint.limits.position.is_none())
}

/// Returns the positions over which sines must be good: those of the box, and
/// [`stated`] angles of a joint that [turns freely](turns_freely).
pub(crate) fn sine_positions(
    robot: &Robot,
    scalar: ScalarType,
    limits: &InputBox,
) -> Vec<Interval> {
    let ranges = limits.position.iter().enumerate();
    let range = |(joint, range): (usize, &Interval)| {
        let every = Interval::symmetric(stated(scalar));
        match turns_freely(robot, joint) {
            true => every,
            false => *range,
        }
    };
    ranges.map(range).collect()
}
