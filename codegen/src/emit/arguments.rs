//! What a module says of parameters that are arguments: the types of a payload and
//! of its load, and where gravity comes from.

use dalembert_checker::payload as checked;
use dalembert_checker::places::Places;
use dalembert_model::outputs::{Axis, RuntimeParameter, Sizes};
use dalembert_model::robot::Robot;

use super::say;
use crate::figures::{decimal, placed};
use crate::function::{Argument, Function, Quantity};
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

fn placed_names(robot: &Robot) -> Option<Places> {
    let names = robot.joints.iter().map(|joint| joint.name.as_deref());
    let names: Vec<Option<&str>> = names.collect();
    let floats = robot.floating.is_some();
    let limbs = floats.then(|| Sizes::of(robot).limb_starts().collect());
    (robot.is_tree()).then(|| Places::new(&names, limbs))
}

/// Returns the constants for the places of the base and of joints in arguments.
pub(super) fn places(robot: &Robot) -> String {
    let Some(places) = placed_names(robot) else {
        return String::new();
    };
    let [_, coordinates] = places.counts;
    let mut text = String::new();
    let mut say = |doc: &str, name: &str, place: usize| {
        text += &format!("/// {doc}\npub const {name}: usize = {place};\n");
    };
    let (what, of) = match robot.floating {
        None => ("The number of entries of a velocity.", "arguments"),
        Some(_) => (
            "The number of entries of velocities, accelerations and torques.",
            "velocities",
        ),
    };
    say(what, "NV", coordinates);
    for (name, place) in &places.velocities {
        let doc = match robot.joint_of(*place) {
            None => {
                "The base's first place in them: linear x, y, z, then angular x, y, z.".to_owned()
            }
            Some(joint) => format!("The place of joint {} in {of}.", joint + 1),
        };
        say(&doc, name, *place);
    }
    for (name, place) in &places.positions {
        let doc = format!("The place of joint {} in positions.", place + 1);
        say(&doc, name, *place);
    }
    let named = "/// The joints' names, in the order of positions.\n";
    text += &format!("{named}{}\n", places.array());
    if let Some(limbs) = places.limbs() {
        let doc = "/// The first joint of each limb, in the order of positions, then the number of joints.\n";
        text += &format!("{doc}{limbs}\n");
    }
    text
}

/// Returns the lines of [`places`] for a header.
pub(super) fn places_c(robot: &Robot, names: &Names) -> String {
    let Some(places) = placed_names(robot) else {
        return String::new();
    };
    let of = match robot.floating {
        None => " * in arguments.",
        Some(_) => {
            " * in velocities, accelerations and torques; behind a Q, in positions. The base has six\n \
             * places: linear x, y, z, then angular x, y, z."
        }
    };
    let limbs = match places.limbs.is_empty() {
        true => "",
        false => ", LIMBS one of the\n * first joint of each limb and the number of joints",
    };
    let header = places.header(&names.macros());
    format!(
        "\n/* The number of joints, and of entries of a velocity; the places of the base and of joints\n\
         {of} NAMES begins an array of strings{limbs}. */\n{header}\n"
    )
}

/// Returns the layout of vectors if the base floats.
pub(super) fn layout(function: Function, setup: &Setup) -> Vec<String> {
    let mut lines = Vec::new();
    if setup.robot().floating.is_none() {
        return lines;
    }
    let coordinates = setup.robot().coordinates();
    let of = |own: &Argument| own.length(setup.sizes(function)) == coordinates;
    let of_results = |own: &Quantity| own.shape().0.contains(&Axis::Coordinates);
    if function.arguments().iter().any(of) || function.quantities().iter().any(of_results) {
        let layout = [
            "",
            "Velocities, accelerations and torques have six entries of the base first, in the base's axes:",
            "linear x, y, z (m/s, m/s², N), angular x, y, z (rad/s, rad/s², N·m). Positions have none.",
        ];
        say(&mut lines, layout);
    }
    let of_limbs = |quantity: &Quantity| quantity.shape().0.contains(&Axis::Limbs);
    if function.quantities().iter().any(of_limbs) {
        let limbs = setup.limbs().into_iter().map(|limb| {
            let joints = limb.iter().map(|joint| (joint + 1).to_string());
            joints.collect::<Vec<String>>().join(", ")
        });
        let limbs = limbs.collect::<Vec<String>>().join("; ");
        say(
            &mut lines,
            ["", &format!("The joints of each limb: {limbs}.")],
        );
    }
    if function.quantities().contains(&Quantity::Gravity) {
        let flight = [
            "",
            "The joints' entries hold the joints only while something holds the base with its six.",
            "In flight nothing does: there these torques alone turn the base.",
        ];
        say(&mut lines, flight);
    }
    lines
}

pub(super) fn meaning(argument: Argument, robot: &Robot) -> &'static str {
    match (argument, &robot.floating) {
        (Argument::Gravity, Some(_)) => "Acceleration of gravity in the base's axes, m/s².",
        _ => argument.meaning(),
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
    if setup.takes(function, RuntimeParameter::Gravity) && setup.robot().floating.is_some() {
        let gravity = [
            "",
            "`g` is the acceleration of gravity, m/s², turned into the axes that the base has now; the same",
            "however the base moves.",
        ];
        say(&mut lines, gravity);
    } else if setup.takes(function, RuntimeParameter::Gravity) {
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
