//! The file as a whole: the robot's own keys, and the lists of joints and frames.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use toml_span::Value;

use super::report::quote;
use super::table::{Table, locate};
use super::value::{Context, bodies, placement};
use super::{Diagnostic, Reading, base, guard, joint, link, mimic, scene, syntax};
use crate::diagnostic::closest;
use crate::placed::{derive, place};
use crate::robot::{Convention, FloatingBase, Frame, Placed, Placement, Robot, RobotWarning};

/// `None` only after an error.
pub(super) fn read(source: &str, cx: &mut Context) -> Option<Reading> {
    if !guard::admits(source, &mut cx.sink) {
        return None;
    }
    let root = match toml_span::parse(source) {
        Ok(root) => root,
        Err(error) => {
            syntax::report(source, &error, &mut cx.sink);
            return None;
        }
    };
    let mut keys = Table::open(cx, &root, "", "the robot", "")?;
    keys.span = 0..0;
    let (robot, findings) = robot(cx, &mut keys);
    for finding in findings {
        let place = in_file(&robot, finding.keys());
        if !cx.is_unread(&place) {
            let span = locate(&root, 0..0, source, &place);
            cx.sink.place(finding, span);
        }
    }
    let outputs = keys.optional(cx, "outputs", |cx, value| cx.outputs(value, "a robot"));
    // Without joints, every joint of a scene would be unknown as well.
    let scenes = keys.get("scene").filter(|_| !robot.joints.is_empty());
    let scenes = scenes.map_or_else(Vec::new, |scenes| scene::read(cx, &robot, &root, scenes));
    keys.finish(cx);
    Some(Reading {
        robot,
        outputs: outputs.unwrap_or_default(),
        scenes,
        notes: Vec::new(),
    })
}

/// Joints are counted without a base that floats, whose table is the first.
fn in_file(robot: &Robot, place: &str) -> String {
    let counted = place.strip_prefix("joint/#").unwrap_or_default();
    if let (Some(_), Some((number, key))) = (&robot.floating, counted.split_once('/'))
        && let Ok(number) = number.parse::<usize>()
    {
        return format!("joint/#{}/{key}", number + 1);
    }
    place.into()
}

fn robot<'v>(cx: &mut Context, keys: &mut Table<'v>) -> (Robot, Vec<Diagnostic>) {
    const NAME: &str = "name = \"puma560\"; the generated module is called after it";
    const WHICH: &str = "\"standard\" where joint i acts along z of frame i − 1, \"modified\" (Craig) where it acts along z of frame i";
    const CONVENTION: &str =
        "convention = \"standard\", or \"modified\" (Craig): row i holds its own A_i's alpha and a";
    const GRAVITY: &str = "gravity = [0, 0, -9.81]: the acceleration of gravity in base axes, m/s²";
    const LIMITS: &str =
        "limits = { payload = { mass = [0, 2], radius = 0.1 } }; those of motion are joints'";
    const JOINT: &str = "each joint is a [[joint]] table, from the base to the hand";

    let name = keys.required(cx, "name", NAME, Context::string);
    let convention = keys.get("convention");
    let gravity = keys.required(cx, "gravity", GRAVITY, |cx, value| {
        cx.array(value, GRAVITY, Context::number)
    });
    let [base, tool, payload_frame] = ["base", "tool", "payload_frame"]
        .map(|key| placement(cx, keys, key).and_then(Placement::unless_identity));
    let payload_range = keys.table(cx, "limits", LIMITS, |cx, keys| bodies(cx, keys, "payload"));
    keys.optional(cx, "allow", allow);
    let notes = keys.optional(cx, "notes", notes);
    keys.get("outputs");
    let read = keys.required(cx, "joint", JOINT, joints);
    let (floating, read) = read.unwrap_or_default();

    let word = |cx: &mut Context, value| cx.word(value, &Convention::WORDS, WHICH);
    let is_placed = floating.is_some() || read.iter().any(|joint| joint.placed.is_some());
    let convention = match (is_placed, convention) {
        (false, _) => keys.required(cx, "convention", CONVENTION, word),
        (true, None) => None,
        (true, Some(value)) => {
            if word(cx, value) == Some(Convention::Modified) {
                let message = "joints that are placed have rows of the standard convention";
                let help = "leave `convention` out: it says how rows are meant, and there are none";
                cx.refuse::<()>(value, message, help);
            }
            None
        }
    };
    let mut robot = Robot {
        name: name.unwrap_or_default(),
        convention: convention.unwrap_or(Convention::Standard),
        gravity: gravity.unwrap_or_default(),
        base,
        tool,
        payload_frame,
        payload_range,
        floating,
        joints: read.iter().map(|read| read.joint.clone()).collect(),
        followers: Vec::new(),
        frames: Vec::new(),
        notes: notes.unwrap_or_default(),
    };
    let frames = keys.optional(cx, "frame", |cx, list| frames(cx, &robot, list));
    robot.frames = frames.unwrap_or_default();
    let parents = link::parents(cx, &robot, &read);
    for (joint, parent) in robot.joints.iter_mut().zip(parents) {
        joint.parent = parent;
    }
    let mimics = mimic::read(cx, &robot.joints, &read);
    let findings = rows(cx, &mut robot, read);
    (mimic::split(cx, robot, &mimics), findings)
}

/// An unknown name is an error: it silences nothing, and its author thinks it does.
fn allow(cx: &mut Context, value: &Value) -> Option<()> {
    let names = RobotWarning::WORDS.map(|(name, _)| name);
    let help = format!("allow = [\"{}\"]", names[0]);
    let items = cx.list(value, "an array of the names of warnings", &help)?;
    cx.each(items, |cx, _, item| {
        let text = cx.string(item)?;
        let mut words = RobotWarning::WORDS.iter();
        if let Some((_, warning)) = words.find(|(name, _)| *name == text) {
            cx.sink.allowed.insert(*warning);
            return Some(());
        }
        let message = format!("there is no warning {}", quote(&text));
        let help = match closest(&text, &names) {
            Some(meant) => format!("did you mean \"{meant}\"?"),
            None => format!("warnings are: {}", names.join(", ")),
        };
        cx.refuse(item, message, &help)
    })?;
    Some(())
}

fn notes(cx: &mut Context, value: &Value) -> Option<Vec<String>> {
    let help = "notes = [\"without springs\"]";
    let items = cx.list(value, "an array of strings", help)?;
    cx.each(items, |cx, _, item| cx.string(item))
}

type Joints<'v> = (Option<FloatingBase>, Vec<joint::Read<'v>>);

fn joints<'v>(cx: &mut Context, list: &'v Value<'v>) -> Option<Joints<'v>> {
    const BRACKETS: &str = "write [[joint]], with two brackets";
    const EACH: &str = "each joint is a [[joint]] table";
    let items = cx.list(list, "[[joint]] tables", BRACKETS)?;
    let (base, items) = match items.split_first() {
        Some((first, others)) if base::floats(first) => {
            let keys = Table::open(cx, first, "joint/#1", "the base", EACH)?;
            (Some(base::read(cx, keys)), others)
        }
        _ => (None, items),
    };
    let first = usize::from(base.is_some());
    let most = Robot::MAX_JOINTS;
    if let Some(item) = items.get(most) {
        let message = format!("a robot has 1 to {most} joints, not {}", items.len());
        cx.refuse::<()>(item, message, "this is the first too many");
    }
    let joints = cx.each(&items[..most.min(items.len())], |cx, index, item| {
        let place = format!("joint/#{}", index + 1 + first);
        let keys = Table::open(cx, item, place, format!("joint {}", index + 1), EACH)?;
        Some(joint::read(cx, keys))
    });
    Some((base, joints?))
}

fn frames(cx: &mut Context, robot: &Robot, list: &Value) -> Option<Vec<Frame>> {
    const NAME: &str = "name = \"camera\": functions are called after it, `jacobian_camera`";
    const LINK: &str = "link = 3, or the name of its joint: what the frame is fixed to";
    const BRACKETS: &str = "write [[frame]], with two brackets";
    // Without joints, every link would be unknown as well.
    if robot.joints.is_empty() {
        return None;
    }
    let items = cx.list(list, "[[frame]] tables", BRACKETS)?;
    cx.each(items, |cx, index, item| {
        let number = index + 1;
        let (place, name) = (format!("frame/#{number}"), format!("frame {number}"));
        let mut keys = Table::open(cx, item, place, name, "each frame is a [[frame]] table")?;
        let name = keys.required(cx, "name", NAME, Context::string);
        let row = keys.required(cx, "link", LINK, |cx, value| {
            match link::is_base(robot, value) {
                true => Some(None),
                false => link::read(cx, &robot.joints, value, LINK).map(Some),
            }
        });
        let placement = cx.placement(&mut keys);
        keys.finish(cx);
        Some(Frame {
            name: name?,
            row: row?,
            placement: placement?,
        })
    })
}

/// Warnings about placed joints are about their placements, not about the rows.
fn rows(cx: &mut Context, robot: &mut Robot, read: Vec<joint::Read>) -> Vec<Diagnostic> {
    let branches = robot.is_tree();
    let is_placed = branches || read.iter().any(|joint| joint.placed.is_some());
    let (why, rows) = match (branches, robot.floating.is_some()) {
        (true, true) => ("the base floats", "begin at a base that is fixed"),
        (true, false) => ("links branch", "cannot say where a branch begins"),
        (false, _) => ("others are", ""),
    };
    let help = match branches {
        true => format!("give all joints a placement and an axis: rows of a table {rows}"),
        false => "give all joints a placement and an axis, or all of them DH rows".into(),
    };
    let mut placed: Vec<Placed> = Vec::with_capacity(read.len());
    for (index, joint) in read.into_iter().enumerate() {
        match joint.placed {
            Some(placed_joint) => placed.push(placed_joint),
            None if is_placed => {
                let message = format!("joint {} is not placed, and {why}", index + 1);
                cx.sink.error(joint.span, message, &help);
            }
            None => {}
        }
    }
    let is_whole = is_placed && placed.len() == robot.joints.len();
    if branches && is_whole {
        place(robot, &placed);
        return robot.validate();
    }
    if branches {
        // The joints that are not placed are reported.
        let mut chain = robot.clone();
        for joint in &mut chain.joints {
            joint.parent = None;
        }
        chain.floating = None;
        chain.frames.retain(|frame| frame.row.is_some());
        return chain.validate();
    }
    if !is_whole || !cx.unread.is_empty() {
        return robot.validate();
    }
    let placements: Vec<Placement> = placed.iter().map(|joint| joint.placement.clone()).collect();
    let mut findings = robot.validate_placed(&placements);
    // Directions of length zero were refused where they stand, and then there is an
    // error already. An oddity of a derived row is none of the file's.
    if derive(robot, &placed).is_ok() && !findings.iter().any(Diagnostic::is_error) {
        findings.extend(robot.validate().into_iter().filter(Diagnostic::is_error));
    }
    findings
}
