//! The file of a robot in Rust: the contents of one module in one scalar, with header, table,
//! structs and functions.

use dalembert_model::number::{Angle, Rational};
use dalembert_model::robot::{Convention, Follower, JointKind, Parent, Placement, Position, Robot};
use dalembert_model::scene::Scene;

use super::escape::{escaped, sentence};
use super::paragraph;
use super::state_box::StateBox;
use super::{arguments, parameters, said, variant};
use crate::emit::GeneratedFunction;
use crate::figures::{decimal, placed};
use crate::language::{Language, columns, comment, function, list, result};
use crate::program::{Code, Counts, ScalarType};
use crate::setup::Setup;
use crate::task::Job;

/// Not every function is called or seen from outside, literals carry all the digits they need,
/// names are the equations', and a flat function is as long as it is.
const ALLOWED: &str = "dead_code, unreachable_pub, clippy::all, clippy::pedantic, clippy::nursery";

pub(crate) fn write(
    job: &Job<'_>,
    functions: &[GeneratedFunction],
    codes: &[Code],
    scalar: ScalarType,
) -> String {
    let (robot, setup, request) = (job.robot, job.setup, job.request);
    let n = robot.joints.len();
    let mut text = comment("//!", &header(robot, setup, functions, scalar));
    // One operation a line, whatever the formatter of the user's crate thinks.
    // Only this way of telling it so is stable as an inner attribute.
    text += &format!("#![cfg_attr(rustfmt, rustfmt_skip)]\n#![allow({ALLOWED})]\n\n");
    text += &format!("/// The number of joints.\npub const N: usize = {n};\n");
    text += &arguments::places(setup.robot());
    let rows = setup.rows();
    if setup.scene().is_some() {
        let (over, what) = match setup.robot().floating {
            None => ("JOINTS", "joints"),
            Some(_) => ("COORDINATES", "coordinates of the velocity"),
        };
        let count = rows.len();
        text += &format!("/// The {what} that results are over, in their order, from zero.\n");
        text += &format!("pub const {over}: [usize; {count}] = {rows:?};\n");
    }
    text.push_str(&arguments::types(setup, scalar));
    if let Some(state_box) = StateBox::of(functions, setup, scalar) {
        state_box.write(&mut text, scalar);
    }
    for (index, (generated, code)) in functions.iter().zip(codes).enumerate() {
        text.push('\n');
        let program = &generated.program;
        if let Some(structure) = result::structure(program.function, program.sizes(), scalar) {
            text += &format!("{structure}\n");
        }
        // One π for all that are over the same columns.
        let columns = generated.function.columns();
        let mut earlier = functions[..index].iter();
        if !earlier.any(|other| other.function.columns() == columns) {
            text.push_str(&parameters::constant(generated.function, setup, scalar));
        }
        let doc = function_doc(job, generated, scalar);
        let library = request.sincos.library();
        text.push_str(&function::write(program, code, library, &doc));
        if request.batch && columns::are_there(program.function, Language::Rust) {
            text += &format!("\n{}", columns::columns(program, code));
        }
    }
    text
}

fn followed(follower: &Follower, number: usize) -> String {
    let by = decimal(&follower.multiplier);
    let offset = match &follower.offset {
        Position::Angle(angle) => angle.to_string(),
        Position::Length(length) => decimal(length),
    };
    match offset.as_str() {
        "0" => format!("{by} q{number}"),
        offset => format!("{by} q{number} + ({offset})"),
    }
}

pub(super) fn header(
    robot: &Robot,
    setup: &Setup,
    functions: &[GeneratedFunction],
    scalar: ScalarType,
) -> Vec<String> {
    let convention = match robot.convention {
        _ if robot.is_tree() => "a tree of links",
        Convention::Standard => "standard DH",
        Convention::Modified => "modified (Craig) DH",
    };
    let (name, n) = (&robot.name, robot.joints.len());
    let gravity = arguments::gravity(robot, setup);
    let mut lines = vec![
        format!("Dynamics of the robot `{name}`, {n} joints, in `{scalar}`."),
        format!("Input hash {}.", robot.short_hash()),
        String::new(),
        format!("SI units, radians; {convention}; {gravity}"),
    ];
    if let Some(base) = &robot.base {
        let at = placed(base);
        lines.push(format!("Base axes are those in which frame 0 is at {at}."));
    }
    if let Some(tool) = &robot.tool {
        let at = placed(tool);
        let what = "The last frame of poses and Jacobians is the tool, in the last link's";
        lines.push(format!("{what} at {at}."));
    }
    if !robot.notes.is_empty() {
        lines.extend(paragraph(["", "Notes of the robot file:", ""]));
        let notes = robot.notes.iter();
        lines.extend(notes.map(|note| format!("- {}", sentence(note))));
    }
    let heads = match robot.is_tree() {
        true => [
            "| joint | kind | carried by | xyz | rpy | axis | mass |",
            "|---|---|---|---|---|---|---|",
        ],
        false => [
            "| joint | kind | α | a | d | θ | mass |",
            "|---|---|---|---|---|---|---|",
        ],
    };
    lines.extend(paragraph([""]));
    lines.extend(paragraph(heads));
    if let Some(base) = &robot.floating {
        let named = |name: &String| format!(" {}", escaped(name));
        let name = base.name.as_ref().map(named).unwrap_or_default();
        let mass = decimal(&base.mass);
        lines.push(format!("| base{name} | floating | | | | | {mass} |"));
    }
    for (row, joint) in robot.rows().into_iter().enumerate() {
        let mut followers = robot.followers.iter();
        let follower = followers.find(|follower| follower.row == row);
        let number = robot.mover_of(row) + 1;
        let label = match (follower, &joint.name) {
            (Some(_), Some(name)) => format!("follows {number}: {}", escaped(name)),
            (Some(_), None) => format!("follows {number}"),
            (None, Some(name)) => format!("{number} {}", escaped(name)),
            (None, None) => number.to_string(),
        };
        let q = follower.map_or_else(
            || format!("q{number}"),
            |follower| followed(follower, number),
        );
        let plus = |constant: String| match constant.as_str() {
            "0" => q.clone(),
            negative if negative.starts_with('-') => format!("{q} - {}", &negative[1..]),
            positive => format!("{q} + {positive}"),
        };
        let kind = match joint.kind {
            JointKind::Revolute => "revolute",
            JointKind::Prismatic => "prismatic",
        };
        if let Some(place) = &joint.place {
            let carrier = match robot.carrier(row) {
                None => "the base".to_owned(),
                Some(carrier) => link_name(robot, carrier),
            };
            let Placement { xyz, rpy } = &place.placement;
            let decimals = |list: &[Rational; 3]| list.each_ref().map(decimal).join(", ");
            let rpy = rpy.each_ref().map(Angle::to_string).join(", ");
            let (xyz, axis) = (decimals(xyz), decimals(&place.axis));
            let mass = decimal(&joint.mass);
            let cells = format!("{carrier} | {xyz} | {rpy} | {axis} | {mass}");
            lines.push(format!("| {label} | {kind} | {cells} |"));
            continue;
        }
        let (d, theta) = (decimal(&joint.d), joint.theta.to_string());
        let (d, theta) = match joint.kind {
            JointKind::Revolute => (d, plus(theta)),
            JointKind::Prismatic => (plus(d), theta),
        };
        let (alpha, a, mass) = (&joint.alpha, decimal(&joint.a), decimal(&joint.mass));
        let cells = format!("{alpha} | {a} | {d} | {theta} | {mass}");
        lines.push(format!("| {label} | {kind} | {cells} |"));
    }
    if !robot.followers.is_empty() {
        let why =
            "Of joints that follow others there are no entries; parameters count links by rows.";
        lines.extend(paragraph(["", why]));
    }
    let rows = (1..).zip(robot.rows());
    let tilted = rows.filter(|(_, joint)| !joint.beta.is_zero());
    let words = tilted.map(|(number, joint)| format!("{number} by {}", joint.beta));
    let turns: Vec<String> = words.collect();
    if !turns.is_empty() {
        let tilted = turns.join(", joint ");
        let why = format!("After its twist each of these turns about y: joint {tilted}.");
        lines.extend(paragraph(["", &why]));
    }
    if let Some(scene) = setup.scene() {
        lines.push(String::new());
        lines.extend(describe(scene, robot));
    }
    lines.push(String::new());
    lines.extend(table(functions));
    lines.push(String::new());
    let proved = match functions.iter().any(|function| function.admitted.is_some()) {
        false => [
            "Every function was proved before it was printed: with exact constants it equals",
            "the equations of motion at random points modulo 2⁶¹ − 465, and this text, read",
            "back, is the proved program with each constant rounded once.",
        ],
        true => [
            "Every function was proved before anything was left out of it: with exact",
            "constants it equals the equations of motion at random points modulo 2⁶¹ − 465.",
            "Each function lists what was then left out of it, within the scene's tolerance.",
        ],
    };
    lines.extend(paragraph(proved));
    lines.extend(paragraph([
        "The points follow from the SHA-256 of robot, scene and program. Each function says how",
        "improbable it is that a wrong one passes.",
    ]));
    lines
}

fn table(functions: &[GeneratedFunction]) -> Vec<String> {
    type Column = (&'static str, bool, fn(&Counts) -> usize);
    let columns: [Column; 6] = [
        ("mul", true, |counts| counts.mul),
        ("add", true, |counts| counts.add),
        ("fma", false, |counts| counts.fma),
        ("div", false, |counts| counts.div),
        ("sqrt", false, |counts| counts.sqrt),
        ("sincos", true, |counts| counts.sincos),
    ];
    let is_shown = |(_, always, of): &&Column| {
        *always || functions.iter().any(|function| of(&function.counts()) > 0)
    };
    let shown: Vec<&Column> = columns.iter().filter(is_shown).collect();
    let titles = shown.iter().map(|(title, ..)| format!(" {title} |"));
    let mut lines = vec![
        format!("| function |{} from |", titles.collect::<String>()),
        format!("|{}", "---|".repeat(shown.len() + 2)),
    ];
    for function in functions {
        let counts = function.counts();
        let cells = shown.iter().map(|(.., of)| format!(" {} |", of(&counts)));
        let (cells, source) = (cells.collect::<String>(), function.source.name());
        lines.push(format!("| `{}` |{cells} {source} |", function.function));
    }
    lines
}

pub(super) fn function_doc(
    job: &Job<'_>,
    generated: &GeneratedFunction,
    scalar: ScalarType,
) -> Vec<String> {
    let setup = job.setup;
    let is_changed = generated.admitted.is_some();
    let before = match is_changed {
        true => ", before anything was left out",
        false => "",
    };
    let mut lines = vec![
        generated.function.summary().to_owned(),
        String::new(),
        format!("{}.", generated.counts_in(scalar)),
        format!("Checked{before}: {}.", generated.proof),
    ];
    lines.extend(said::lanes(&generated.program));
    lines.extend(said::fused(&generated.program));
    if generated.program.divides() {
        lines.extend(paragraph([
            "",
            "Divides by the pivots of D, which are positive wherever D is positive definite. Where a",
            "joint moves no inertia a pivot is zero, and results are infinite or NaN. So rounding is measured",
            "at states by `dalembert certify`, not shown: it has no bound over the box.",
        ]));
    }
    lines.extend(said::friction(generated, setup));
    lines.extend(arguments::layout(generated.function, setup));
    lines.extend(arguments::doc(generated.function, setup));
    lines.extend(parameters::doc(generated.function, setup));
    lines.extend(said::sines(generated.sines(scalar), scalar));
    if let Some(admitted) = &generated.admitted
        && let Some(variant) = generated.variant(scalar)
    {
        lines.extend(variant::describe(admitted, variant, setup));
    }
    lines
}

fn link_name(robot: &Robot, row: usize) -> String {
    match &robot.rows()[row].name {
        Some(name) => escaped(name),
        None => format!("link {}", row + 1),
    }
}

fn describe(scene: &Scene, robot: &Robot) -> Vec<String> {
    let (name, hash) = (&scene.name, scene.short_hash());
    let head = format!("Scene `{name}` {hash}. Its functions are the full model's at:");
    let mut lines = vec![head];
    if scene.lock_base {
        lines.push("- the base at rest;".to_owned());
    }
    for (joint, at) in &scene.lock {
        let at = match at {
            Position::Angle(angle) => format!("{angle} rad"),
            Position::Length(length) => format!("{} m", decimal(length)),
        };
        lines.push(format!("- q{0} = {at}, q̇{0} = q̈{0} = 0;", joint + 1));
    }
    for (zero, rate) in [(scene.velocity_zero, "q̇"), (scene.acceleration_zero, "q̈")] {
        if zero {
            lines.push(format!("- {rate} = 0;"));
        }
    }
    if let Some(gravity) = &scene.gravity {
        let gravity = list(gravity.iter().map(decimal));
        let text = format!("- gravity ({gravity}) m/s², instead of the robot's;");
        lines.push(text);
    }
    if let Some(payload) = &scene.payload {
        let mass = decimal(&payload.mass);
        let com = list(payload.com.iter().map(decimal));
        let named = |link| match link {
            Parent::Base => "the base".to_owned(),
            Parent::Row(row) => link_name(robot, row),
        };
        let link = (scene.payload_link).map_or_else(|| "the last link".to_owned(), named);
        let body = format!("a payload of {mass} kg at ({com}) m");
        lines.push(format!("- {body} in the frame of {link};"));
    }
    let rows = scene.rows(robot.joints.len());
    let rows = list(rows.iter().map(|row| (row + 1).to_string()));
    let what = "every index of a result counts these.";
    lines.push(format!("- results over the joints {rows}: {what}"));
    let read = "Arguments have an entry for every joint; those of locked joints are not read.";
    lines.extend(paragraph(["", read]));
    lines
}
