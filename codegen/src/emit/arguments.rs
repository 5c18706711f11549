//! What a module says of parameters that are arguments: the types of a payload and
//! of its load, and where gravity comes from.

use dalembert_model::outputs::RuntimeParameter;
use dalembert_model::robot::Robot;

use super::say;
use crate::figures::{decimal, placed};
use crate::function::{Argument, Function};
use crate::language::function::{GRAVITY, LOAD, PAYLOAD};
use crate::language::list;
use crate::program::ScalarType;
use crate::setup::Setup;

/// Returns what gravity is, for the header.
pub(super) fn gravity(robot: &Robot, setup: &Setup) -> String {
    let file = list(robot.gravity.iter().map(decimal));
    match setup.has(RuntimeParameter::Gravity) {
        false => format!("gravity ({file}) m/s² in base axes."),
        true => {
            format!("gravity is the argument `g` in m/s² and base axes ({file} in the robot file).")
        }
    }
}

/// The types of arguments that are no joint vectors; nothing where there are none.
pub(super) fn types(setup: &Setup, scalar: ScalarType) -> String {
    let mut text = String::new();
    if setup.has(RuntimeParameter::Gravity) {
        text += "/// The acceleration of gravity in base axes, in m/s²: x, y and z.\n";
        newtype(&mut text, GRAVITY, scalar, 3);
    }
    if !setup.has(RuntimeParameter::Payload) {
        return text;
    }
    let frame = payload_frame(setup).replace(" at ", "\n/// at ");
    text += "/// A body that is fixed to the last link, beside what the robot file has there: see\n\
             /// [`Payload::new`], whose arguments these are, in their order.\n";
    newtype(&mut text, PAYLOAD, scalar, 10);
    text += &format!(
        "impl {PAYLOAD} {{\n\
         /// Nothing is carried.\n\
         pub const NONE: {PAYLOAD} = {PAYLOAD}([0.0; 10]);\n\
         /// A body of this `mass` in kg. `com` is its centre of mass in m, in the last link's frame,\n\
         /// {frame}\n\
         /// (a tool's pose moves poses and Jacobians only). `inertia` is its tensor about the centre of\n\
         /// mass in kg·m², in the axes of that frame: Ixx, Iyy, Izz, Ixy, Iyz, Ixz as they stand in the\n\
         /// matrix.\n\
         #[must_use]\n\
         pub const fn new(mass: {scalar}, com: [{scalar}; 3], inertia: [{scalar}; 6]) -> {PAYLOAD} {{\n    \
         let ([x, y, z], [xx, yy, zz, xy, yz, xz]) = (com, inertia);\n    \
         {PAYLOAD}([mass, x, y, z, xx, yy, zz, xy, yz, xz])\n}}\n}}\n"
    );
    text += "/// The regrouped parameters that a payload changes: what [`load`] returns, and what the other\n\
             /// functions take. Compute it once for each tool; its numbers are this module's own.\n";
    let length = Argument::Load.length(setup.sizes(Function::Load));
    newtype(&mut text, LOAD, scalar, length);
    text
}

/// Returns where the frame that payloads are given in is.
fn payload_frame(setup: &Setup) -> String {
    let n = setup.joints();
    match setup.robot().payload_frame.as_ref() {
        None => format!("that of joint {n} in the table"),
        Some(frame) => format!(
            "which is in that of joint {n} in the table at {}",
            placed(frame)
        ),
    }
}

/// Describes an argument of C, of a payload each of its numbers.
pub(super) fn described(argument: Argument, setup: &Setup) -> Vec<String> {
    if argument != Argument::Payload {
        return vec![argument.meaning().to_owned()];
    }
    let frame = payload_frame(setup);
    let text = format!(
        "A body fixed to the last link, beside what the robot file has there; zeros: none.\n  \
         [0] its mass, kg; [1] to [3] its centre of mass x, y, z, m, in the last link's frame,\n  \
         {frame}\n  \
         (a tool's pose moves poses and Jacobians only); [4] to [9] its inertia Ixx, Iyy, Izz,\n  \
         Ixy, Iyz, Ixz, kg·m², about its centre of mass, in the axes of that frame."
    );
    text.lines().map(str::to_owned).collect()
}

/// Writes a type of so many numbers.
fn newtype(text: &mut String, name: &str, scalar: ScalarType, length: usize) {
    *text += &format!(
        "#[derive(Clone, Copy, Debug, PartialEq)]\n#[repr(transparent)]\n\
         pub struct {name}(pub [{scalar}; {length}]);\n\
         impl ::core::ops::Deref for {name} {{\n    type Target = [{scalar}; {length}];\n    \
         #[inline(always)]\n    fn deref(&self) -> &[{scalar}; {length}] {{\n        &self.0\n    }}\n}}\n"
    );
}

/// Returns what a function's arguments are that are no joint vectors.
pub(super) fn doc(function: Function, setup: &Setup) -> Vec<String> {
    let mut lines = Vec::new();
    if setup.takes(function, RuntimeParameter::Gravity) {
        let gravity = [
            "",
            "`g` is the acceleration of gravity in base axes, m/s². Where the base is tilted, turn it into",
            "the base's axes; where it moves without turning, subtract its acceleration.",
        ];
        say(&mut lines, gravity);
    }
    if setup.takes(function, RuntimeParameter::Payload) {
        let load = [
            "",
            "`load` is what [`load`] returns of what the hand carries. Proved with all ten numbers of",
            "the payload as variables.",
        ];
        say(&mut lines, load);
    }
    lines
}
