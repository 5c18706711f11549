//! Frames that functions are at: the robot must have them.

use dalembert_model::read::closest;
use dalembert_model::robot::{HAND, Robot};

use super::GenerateError;
use crate::function::Function;

/// Refuses a function at a frame that a robot does not have.
///
/// # Errors
/// The name, with the likely fix.
pub(super) fn check(robot: &Robot, function: Function) -> Result<(), GenerateError> {
    let frames = robot.frames.iter();
    let names: Vec<&str> = frames.map(|frame| frame.name.as_str()).collect();
    let known = |frame: &&str| *frame == HAND || names.contains(frame);
    let Some(frame) = function.frames().into_iter().find(|frame| !known(frame)) else {
        return Ok(());
    };
    let fix = match (closest(frame, &names), names.as_slice()) {
        (Some(meant), _) => format!("did you mean `{meant}`?"),
        (None, []) => format!("it has `{HAND}`; others are [[frame]] tables of its file"),
        (None, names) => format!("it has `{HAND}`, `{}`", names.join("`, `")),
    };
    let message = format!("`{}`: the robot has no frame `{frame}`", function.text());
    Err(GenerateError::refused(function, message, fix))
}
