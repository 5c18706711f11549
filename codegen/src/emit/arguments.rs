//! What a module says of parameters that are arguments: the types of a payload and
//! of its load, and where gravity comes from.

use std::fmt::Write;

use dalembert_model::outputs::RuntimeParameter;
use dalembert_model::robot::Robot;

use super::figures::{decimal, placed};
use crate::function::{Argument, Function};
use crate::language::function::{LOAD, PAYLOAD};
use crate::program::ScalarType;
use crate::scene::SceneRobot;

/// What gravity is, for the header.
pub(super) fn gravity(robot: &Robot, scene_robot: &SceneRobot) -> String {
    let components: Vec<String> = robot.gravity.iter().map(decimal).collect();
    let file = components.join(", ");
    match scene_robot.has(RuntimeParameter::Gravity) {
        false => format!("gravity ({file}) m/s² in base axes."),
        true => {
            format!("gravity is the argument `g` in m/s² and base axes ({file} in the robot file).")
        }
    }
}

/// The types of a payload and of its load; nothing where there is none.
pub(super) fn types(scene_robot: &SceneRobot, scalar: ScalarType) -> String {
    let mut text = String::new();
    if !scene_robot.has(RuntimeParameter::Payload) {
        return text;
    }
    let sizes = scene_robot.sizes(Function::Load);
    let [payload, load] = [Argument::Payload, Argument::Load].map(|a| a.length(sizes));
    let n = scene_robot.joints().len();
    let frame = match scene_robot.robot().payload_frame.as_ref() {
        None => format!("that of joint {n} in the table"),
        Some(frame) => {
            let at = placed(frame);
            format!("which is in that of joint {n} in the table\n/// at {at}")
        }
    };
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "/// A body that is fixed to the last link, beside what the robot file has there: its mass in kg;\n\
         /// x, y and z of its centre of mass in m, in the last link's frame, {frame}\n\
         /// (a tool's pose moves poses and Jacobians only); and its inertia tensor about the centre of\n\
         /// mass in kg·m², in the axes of that frame: Ixx, Iyy, Izz, Ixy, Iyz, Ixz as they stand in the\n\
         /// matrix. All zero: nothing is carried.\n\
         pub type {PAYLOAD} = [{scalar}; {payload}];\n\
         /// The regrouped parameters that a payload changes: what [`load`] returns, and what the other\n\
         /// functions take. Compute it once for each tool; its numbers are this module's own.\n\
         pub type {LOAD} = [{scalar}; {load}];",
    );
    text
}

/// What a function's arguments are that are no joint vectors.
pub(super) fn doc(function: Function, scene_robot: &SceneRobot) -> Vec<String> {
    let mut lines = Vec::new();
    if scene_robot.takes(function, RuntimeParameter::Gravity) {
        lines.extend([
            String::new(),
            "`g` is the acceleration of gravity in base axes, m/s². Where the base is tilted, turn it into".into(),
            "the base's axes; where it moves without turning, subtract its acceleration.".into(),
        ]);
    }
    if scene_robot.takes(function, RuntimeParameter::Payload) {
        lines.extend([
            String::new(),
            "`load` is what [`load`] returns of what the hand carries. Proved with all ten numbers of".into(),
            "the payload as variables.".into(),
        ]);
    }
    lines
}
