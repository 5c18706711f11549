//! The text of a module about parameters that are arguments: the types of a payload and
//! of its load, and where gravity comes from.

use dalembert_checker::payload as checked;
use dalembert_checker::places::Places;
use dalembert_model::outputs::{Axis, RuntimeParameter, Sizes};
use dalembert_model::robot::{Joint, Robot};

use super::paragraph;
use crate::figures::{decimal, placed};
use crate::function::{Argument, Function, Quantity};
use crate::language::c99::{Names, float};
use crate::language::function::{BODIES, BODY, GRAVITY, LOAD, PAYLOAD};
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
    let joints = robot.joints.iter();
    let names: Vec<Option<&str>> = joints.map(|joint| joint.name.as_deref()).collect();
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
    let (lists, list) = match robot.floating {
        None => ("a velocity", "arguments"),
        Some(_) => ("velocities, accelerations and torques", "velocities"),
    };
    let doc = format!("The number of entries of {lists}.");
    say(&doc, "NV", coordinates);
    for (name, place) in &places.velocities {
        let doc = match robot.joint_of(*place) {
            None => {
                "The base's first place in them: linear x, y, z, then angular x, y, z.".to_owned()
            }
            Some(joint) => format!("The place of joint {} in {list}.", joint + 1),
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
    let of = |argument: &Argument| argument.length(setup.sizes(function)) == coordinates;
    let of_results = |quantity: &Quantity| quantity.shape().0.contains(&Axis::Coordinates);
    if function.arguments().iter().any(of) || function.quantities().iter().any(of_results) {
        lines.extend(paragraph([
            "",
            "Velocities, accelerations and torques have six entries of the base first, in the base's axes:",
            "linear x, y, z (m/s, m/s², N), angular x, y, z (rad/s, rad/s², N·m). Positions have none.",
        ]));
    }
    let of_limbs = |quantity: &Quantity| quantity.shape().0.contains(&Axis::Limbs);
    if function.quantities().iter().any(of_limbs) {
        let joints = |limb: &Vec<usize>| list(limb.iter().map(|joint| (joint + 1).to_string()));
        let limbs: Vec<String> = setup.limbs().iter().map(joints).collect();
        let text = format!("The joints of each limb: {}.", limbs.join("; "));
        lines.extend([String::new(), text]);
    }
    if function.quantities().contains(&Quantity::Gravity) {
        lines.extend(paragraph([
            "",
            "The joints' entries hold the joints only while something holds the base with its six.",
            "In flight nothing does: there these torques alone turn the base.",
        ]));
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
    if setup.has(RuntimeParameter::Payload) {
        text += "/// A body that is fixed to the last link, beside what the robot file has there: see\n\
                 /// [`Payload::new`], whose arguments these are, in their order.\n";
        newtype(&mut text, PAYLOAD, "", scalar, 10);
        let doc = payload(setup, scalar);
        text += &methods(PAYLOAD, "Nothing is carried.", &doc, scalar);
    }
    if setup.has(RuntimeParameter::Bodies) {
        bodies(&mut text, setup, scalar);
    }
    for (parameter, doc) in DRIVES {
        if setup.has(parameter) {
            let values = setup.defaults(parameter, scalar);
            let values = list(values.iter().map(|literal| literal.text(scalar)));
            let (name, rows) = (parameter.name().to_uppercase(), setup.robot().rows().len());
            text += &format!(
                "/// {doc} of this robot.\npub const {name}: [{scalar}; {rows}] = [{values}];\n"
            );
        }
    }
    if setup.has_load() {
        text += load_doc(setup);
        let length = Argument::Load.length(setup.sizes(Function::Load));
        newtype(&mut text, LOAD, "", scalar, length);
    }
    text
}

const DRIVES: [(RuntimeParameter, &str); 2] = [
    (
        RuntimeParameter::Armature,
        "The rotors' inertias, kg·m² or kg, one a row of the table,",
    ),
    (
        RuntimeParameter::Viscous,
        "The viscous friction, N·m·s/rad or N·s/m, one a row of the table,",
    ),
];

fn load_doc(setup: &Setup) -> &'static str {
    match RuntimeParameter::LOADING.map(|parameter| setup.has(parameter)) {
        [false, false, false, true] => {
            "/// The regrouped parameters that a payload changes: what [`load`] returns, and what the other\n\
             /// functions take. Compute it once for each tool; its numbers are this module's own.\n"
        }
        _ => {
            "/// The regrouped parameters of the arguments of [`load`]: what that returns, and what the other\n\
             /// functions take. Compute it once for each set of them; its numbers are this module's own.\n"
        }
    }
}

fn methods(kind: &str, none: &str, doc: &[String], scalar: ScalarType) -> String {
    let none_doc = format!("/// {none}\npub");
    let code = checked::rust(scalar == ScalarType::F32, kind).replacen("pub", &none_doc, 1);
    let (new, doc) = ("pub const fn", comment("///", doc));
    let documented = format!(
        "/// A body of these numbers; `None` if no body has them.\n///\n{doc}#[must_use]\n{new}"
    );
    indented(&code.replace(new, &documented))
}

fn bodies(text: &mut String, setup: &Setup, scalar: ScalarType) {
    let count = setup.body_links().len();
    *text +=
        "/// The body of a link: see [`Body::new`], whose arguments these are, in their order.\n";
    newtype(text, BODY, "", scalar, 10);
    let doc = body(setup, scalar);
    *text += &methods(BODY, "A link that weighs nothing.", &doc, scalar);
    *text += &format!("/// {}\n", of_links(setup));
    newtype(text, BODIES, "", scalar, 10 * count);
    let kept = match setup.zeros() {
        [] => "",
        _ => ", or a number that is zero in the robot file is another in the body",
    };
    let with = format!(
        "/// These with another body in a place, from zero.\n///\n/// # Panics\n\
         /// There is no such place{kept}.\n#[must_use]\npub const fn"
    );
    let methods = checked::rust_bodies(count, setup.zeros());
    *text += &indented(&methods.replacen("pub const fn", &with, 1));
    *text += "/// The bodies of this robot.\npub const BODIES: Bodies = Bodies([\n";
    for numbers in setup.defaults(RuntimeParameter::Bodies, scalar).chunks(10) {
        let numbers = list(numbers.iter().map(|number| number.text(scalar)));
        *text += &format!("    {numbers},\n");
    }
    *text += "]);\n";
}

fn of_links(setup: &Setup) -> String {
    let named = |link: usize| match link {
        0 => "the base".to_owned(),
        link => link.to_string(),
    };
    let links = list(setup.body_links().into_iter().map(named));
    format!("The bodies of links: {links}, in this order.")
}

pub(super) fn payload_c(setup: &Setup, names: &Names) -> (Vec<String>, String) {
    let dialect = names.dialect();
    let mut doc = Vec::from(paragraph([
        "A body fixed to the last link, beside what the robot file has there. `numbers` has [0] its",
        "`mass`, [1] to [3] its `com` and [4] to [9] its `inertia`; zeros: nothing is carried. Returns",
        "1, or 0 if no body has these numbers; then `payload` stays as it was.",
        "",
    ]));
    doc.extend(payload(setup, dialect.scalar));
    let symbols = names.symbols(Function::Load);
    let is_single = dialect.scalar == ScalarType::F32;
    let prefixes = [symbols.prefix.as_str(), &symbols.macros];
    let text = checked::c(is_single, dialect.function, prefixes, "payload");
    (doc, indented(&text))
}

/// Returns, for a header, each type of bodies and drives with its comment.
pub(super) fn bodies_c(setup: &Setup, names: &Names) -> Vec<(Vec<String>, String)> {
    let (dialect, symbols) = (names.dialect(), names.symbols(Function::Load));
    let (scalar, is_single) = (dialect.scalar, dialect.scalar == ScalarType::F32);
    let mut items = Vec::new();
    let prefixes @ [prefix, macros] = [symbols.prefix.as_str(), &symbols.macros];
    if setup.has(RuntimeParameter::Bodies) {
        let mut doc = Vec::from(paragraph([
            "The body of a link. `numbers` has [0] its `mass`, [1] to [3] its `com` and [4] to [9] its",
            "`inertia`. Returns 1, or 0 if no body has these numbers; then `body` stays as it was.",
            "",
        ]));
        doc.extend(body(setup, scalar));
        let text = checked::c(is_single, dialect.function, prefixes, "body");
        items.push((doc, indented(&text)));
        let kept = match setup.zeros() {
            [] => "",
            _ => ", or a\nnumber that is zero in the robot file is another in the body",
        };
        let said = format!(
            "The function puts a body in a place, from zero: returns 1, or 0 if there is no such place{kept}."
        );
        let mut doc = vec![of_links(setup)];
        doc.extend(said.lines().map(String::from));
        let count = setup.body_links().len();
        let text = checked::c_bodies(
            is_single,
            dialect.function,
            prefixes,
            (count, setup.zeros()),
        );
        items.push((doc, indented(&text)));
        let kind = format!("{prefix}_bodies_t into[{macros}_RESTRICT 1]");
        let into = [kind.as_str(), "into->bodies"];
        let doc = vec!["Fills in the bodies of this robot.".to_owned()];
        items.push((doc, filling(setup, RuntimeParameter::Bodies, names, into)));
    }
    for (parameter, doc) in DRIVES {
        if setup.has(parameter) {
            let (real, rows) = (float(scalar), setup.robot().rows().len());
            let kind = format!("{real} into[{macros}_RESTRICT {rows}]");
            let doc = vec![doc.replacen("The", "Fills in the", 1) + " of this robot."];
            items.push((doc, filling(setup, parameter, names, [&kind, "into"])));
        }
    }
    items
}

/// Writes the function that fills in what the robot has in the place of an argument.
fn filling(
    setup: &Setup,
    parameter: RuntimeParameter,
    names: &Names,
    [kind, array]: [&str; 2],
) -> String {
    let (dialect, symbols) = (names.dialect(), names.symbols(Function::Load));
    let name = format!("{}_{}", symbols.prefix, parameter.name());
    let mut text = format!("{} void {name}({kind})\n{{\n", dialect.function);
    for (place, value) in setup.defaults(parameter, dialect.scalar).iter().enumerate() {
        text += &format!("    {array}[{place}] = {};\n", dialect.literal(*value));
    }
    text + "}\n"
}

fn body(setup: &Setup, scalar: ScalarType) -> Vec<String> {
    let is_placed = |row: &&Joint| row.frame.is_some() || row.place.is_some();
    let link = match setup.robot().rows().iter().any(is_placed) {
        true => "link in the robot file, that of its placement",
        false => "link, that of its row in the table",
    };
    let digits = scalar.of("six", "three");
    let text = format!(
        "`mass` is in kg, zero or more; `com` is the centre of mass in m, in the frame of the\n\
         {link}. `inertia` is its tensor about the centre of mass in kg·m²,\n\
         in the axes of that frame: Ixx, Iyy, Izz, Ixy, Iyz, Ixz as they stand in the matrix. No\n\
         principal moment exceeds the sum of the other two, to {digits} digits."
    );
    text.lines().map(str::to_owned).collect()
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
    if let Some(placement) = &setup.robot().payload_frame {
        frame = format!("which is in {frame}\nat {}", placed(placement));
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
        lines.extend(paragraph([
            "",
            "`g` is the acceleration of gravity, m/s², turned into the axes that the base has now; the same",
            "however the base moves.",
        ]));
    } else if setup.takes(function, RuntimeParameter::Gravity) {
        lines.extend(paragraph([
            "",
            "`g` is the acceleration of gravity in base axes, m/s². Where the base is tilted, turn it into",
            "the base's axes; where it moves without turning, subtract its acceleration.",
        ]));
    }
    if setup.takes_load(function) && !setup.has(RuntimeParameter::Payload) {
        lines.extend(paragraph([
            "",
            "`load` is what [`load`] returns of bodies and drives. Proved with all of their numbers as",
            "variables.",
        ]));
    }
    if setup.takes(function, RuntimeParameter::Payload) {
        lines.extend(paragraph([
            "",
            "`load` is what [`load`] returns of what the hand carries. Proved with all ten numbers of",
            "the payload as variables.",
        ]));
    }
    lines
}
