//! What a module says of parameters that are arguments: the types of a payload and
//! of its load, and where gravity comes from.

use dalembert_checker::payload as checked;
use dalembert_model::outputs::RuntimeParameter;
use dalembert_model::robot::Robot;

use super::say;
use crate::figures::{decimal, placed};
use crate::function::{Argument, Function};
use crate::language::c99::Names;
use crate::language::function::{GRAVITY, LOAD, PAYLOAD};
use crate::language::{comment, list};
use crate::program::ScalarType;
use crate::setup::Setup;

pub(super) fn gravity(robot: &Robot, setup: &Setup) -> String {
    let file = list(robot.gravity.iter().map(decimal));
    match setup.has(RuntimeParameter::Gravity) {
        false => format!("gravity ({file}) m/s² in base axes."),
        true => {
            format!("gravity is the argument `g` in m/s² and base axes ({file} in the robot file).")
        }
    }
}

pub(super) fn types(setup: &Setup, scalar: ScalarType) -> String {
    let mut text = String::new();
    if setup.has(RuntimeParameter::Gravity) {
        text += "/// The acceleration of gravity in base axes, in m/s²: x, y and z.\n";
        newtype(&mut text, GRAVITY, "pub ", scalar, 3);
    }
    if !setup.has(RuntimeParameter::Payload) {
        return text;
    }
    text += "/// A body that is fixed to the last link, beside what the robot file has there: see\n\
             /// [`Payload::new`], whose arguments these are, in their order.\n";
    newtype(&mut text, PAYLOAD, "", scalar, 10);
    let doc = comment("///", &payload(setup, scalar));
    let methods = checked::rust(scalar == ScalarType::F32);
    let methods = methods.replacen("pub", "/// Nothing is carried.\npub", 1);
    let new = "pub const fn";
    let documented = format!(
        "/// A body of these numbers; `None` if no body has them.\n///\n{doc}#[must_use]\n{new}"
    );
    text.push_str(&indented(&methods.replace(new, &documented)));
    text += "/// The regrouped parameters that a payload changes: what [`load`] returns, and what the other\n\
             /// functions take. Compute it once for each tool; its numbers are this module's own.\n";
    let length = Argument::Load.length(setup.sizes(Function::Load));
    newtype(&mut text, LOAD, "", scalar, length);
    text
}

pub(super) fn payload_c(setup: &Setup, names: &Names) -> (Vec<String>, String) {
    let dialect = names.dialect();
    let mut doc = Vec::new();
    let head = [
        "A body fixed to the last link, beside what the robot file has there. `numbers` has [0] its",
        "`mass`, [1] to [3] its `com` and [4] to [9] its `inertia`; zeros: nothing is carried. Returns",
        "1, or 0 if no body has these numbers; then `payload` stays as it was.",
        "",
    ];
    say(&mut doc, head);
    doc.extend(payload(setup, dialect.scalar));
    let own = names.symbols(Function::Load);
    let is_single = dialect.scalar == ScalarType::F32;
    let text = checked::c(is_single, dialect.function, &own.prefix, &own.macros);
    (doc, indented(&text))
}

fn indented(text: &str) -> String {
    let mut depth = 0usize;
    let line = |line: &str| {
        depth -= usize::from(line.starts_with('}'));
        let text = format!("{}{line}\n", "    ".repeat(depth));
        depth += usize::from(line.ends_with('{'));
        text
    };
    text.lines().map(line).collect()
}

fn payload(setup: &Setup, scalar: ScalarType) -> Vec<String> {
    let n = setup.joints();
    let mut frame = format!("that of joint {n} in the table");
    if let Some(own) = &setup.robot().payload_frame {
        frame = format!("which is in {frame}\nat {}", placed(own));
    }
    let digits = scalar.of("six", "three");
    let text = format!(
        "`mass` is in kg, zero or more; `com` is the centre of mass in m, in the last link's frame,\n\
         {frame}\n\
         (a tool's pose moves poses and Jacobians only). `inertia` is its tensor about the centre of\n\
         mass in kg·m², in the axes of that frame: Ixx, Iyy, Izz, Ixy, Iyz, Ixz as they stand in the\n\
         matrix. No principal moment exceeds the sum of the other two, to {digits} digits."
    );
    text.lines().map(str::to_owned).collect()
}

fn newtype(text: &mut String, name: &str, public: &str, scalar: ScalarType, length: usize) {
    *text += &format!(
        "#[derive(Clone, Copy, Debug, PartialEq)]\n#[repr(transparent)]\n\
         pub struct {name}({public}[{scalar}; {length}]);\n\
         impl ::core::ops::Deref for {name} {{\n    type Target = [{scalar}; {length}];\n    \
         #[inline(always)]\n    fn deref(&self) -> &[{scalar}; {length}] {{\n        &self.0\n    }}\n}}\n"
    );
}

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
