//! The file as a whole: the robot's own keys, and the list of joints.

use alloc::format;
use alloc::string::ToString;
use alloc::vec::Vec;
use core::ops::Range;

use num_traits::Zero;
use toml_span::Value;

use super::places::Places;
use super::report::Sink;
use super::table::Keys;
use super::value::{Context, first_line};
use super::{Options, allow, frame, guard, joint, mimic, outputs, placed, scene, syntax};
use crate::number::Rational;
use crate::outputs::Function;
use crate::placed::Placed;
use crate::robot::{Convention, Finding, Joint, Place, Placement, Robot};
use crate::scene::Scene;

/// The keys of a robot.
const KEYS: [&str; 11] = [
    "name",
    "convention",
    "gravity",
    "base",
    "tool",
    "payload_frame",
    "allow",
    "outputs",
    "joint",
    "frame",
    "scene",
];

/// Reads a robot, reporting to the sink; `None` only after an error.
pub(super) fn read<'s>(
    source: &'s str,
    options: &Options,
    sink: &mut Sink<'s>,
) -> Option<(Robot, Vec<Function>, Vec<Scene>)> {
    if !guard::admits(source, sink) {
        return None;
    }
    let root = match toml_span::parse(source) {
        Ok(root) => root,
        Err(error) => {
            syntax::report(source, &error, sink);
            return None;
        }
    };
    let mut cx = Context {
        source,
        snap: options.snap,
        sink,
    };
    let mut places = Places::default();
    let (robot, findings) = robot(&mut cx, &mut places, &root)?;
    for finding in findings {
        if !places.was_read(finding.place) {
            continue;
        }
        let span = places.span(finding.place).unwrap_or(0..0);
        let help = finding.help.unwrap_or_default();
        cx.sink.found(finding.warning, span, finding.message, &help);
    }
    let key = |key| root.as_table().and_then(|table| table.get(key));
    let outputs = key("outputs").and_then(|value| outputs::read(&mut cx, value, "a robot"));
    let scenes = key("scene");
    // Without joints, every joint of a scene would be unknown as well.
    let scenes = scenes.filter(|_| !robot.joints.is_empty());
    let scenes = scenes.map_or_else(Vec::new, |scenes| {
        scene::read(&mut cx, &robot, &places, scenes)
    });
    Some((robot, outputs.unwrap_or_default(), scenes))
}

/// Returns the robot, and what is wrong or odd about it beside what cannot be read.
fn robot(cx: &mut Context, places: &mut Places, root: &Value) -> Option<(Robot, Vec<Finding>)> {
    let keys = Keys {
        table: cx.table(root, "")?,
        span: 0..0,
        what: "the robot".to_string(),
    };
    keys.reject_unknown(&KEYS, cx.sink);
    let at = |value: Option<&Value>| value.map_or(0..0, Context::span);

    let name = keys.require(
        "name",
        "name = \"puma560\"; the generated module is called after it",
        cx.sink,
    );
    let text = name.and_then(|value| cx.string(value));
    let name = places.keep(Place::Name, at(name), text, Default::default);

    const GRAVITY: &str = "gravity = [0, 0, -9.81]: the acceleration of gravity in base axes, m/s²";
    let gravity = keys.require("gravity", GRAVITY, cx.sink);
    let vector = gravity.and_then(|value| cx.array(value, GRAVITY, Context::number));
    let gravity = places.keep(Place::Gravity, at(gravity), vector, || {
        [(); 3].map(|()| Rational::zero())
    });

    if let Some(value) = keys.get("allow") {
        allow::read(cx, value);
    }

    let base = placement(cx, places, &keys, "base", Place::Base);
    let tool = placement(cx, places, &keys, "tool", Place::Tool);
    let payload_frame = placement(cx, places, &keys, "payload_frame", Place::PayloadFrame);

    let list = keys.require(
        "joint",
        "each joint is a [[joint]] table, from the base to the hand",
        cx.sink,
    );
    let span = list.map_or(0..0, |list| first_line(cx.source, Context::span(list)));
    let read = list.and_then(|list| joints(cx, places, list));
    let read = places.keep(Place::Joints, span, read, Vec::new);

    const WHICH: &str = "\"standard\" where joint i acts along z of frame i − 1, \"modified\" (Craig) where it acts along z of frame i";
    const CONVENTION: &str =
        "convention = \"standard\", or \"modified\" (Craig): row i holds its own A_i's alpha and a";
    let convention = match read.iter().any(|joint| joint.placed.is_some()) {
        true => placed::convention(cx, keys.get("convention")),
        false => keys
            .require("convention", CONVENTION, cx.sink)
            .and_then(|value| cx.word_or(value, &Convention::WORDS, WHICH))
            .unwrap_or(Convention::Standard),
    };
    let (joints, placements) = read
        .into_iter()
        .map(|read| (read.joint, (read.placed, read.span)))
        .unzip();
    let mut robot = Robot {
        name,
        convention,
        gravity,
        base,
        tool,
        payload_frame,
        joints,
        followers: Vec::new(),
        frames: Vec::new(),
    };
    robot.frames = keys.get("frame").map_or_else(Vec::new, |list| {
        frame::read(cx, places, &robot.joints, list)
    });
    let mimics = list
        .and_then(Value::as_array)
        .map_or(&[][..], Vec::as_slice);
    let mimics = mimics.iter().map(|item| item.as_table()?.get("mimic"));
    let mimics = mimic::read(cx, &robot.joints, &mimics.collect::<Vec<_>>());
    let findings = placed::rows(cx, places, &mut robot, placements);
    Some((mimic::split(cx, robot, &mimics), findings))
}

/// A `[[joint]]` table.
struct Read {
    joint: Joint,
    /// Where it is, if it has no row.
    placed: Option<Placed>,
    span: Range<usize>,
}

/// Returns a placement that a key may give.
fn placement(
    cx: &mut Context,
    places: &mut Places,
    keys: &Keys,
    key: &str,
    place: Place,
) -> Option<Placement> {
    let value = keys.get(key)?;
    let read = cx.placement(value, key);
    let span = first_line(cx.source, Context::span(value));
    places
        .keep(place, span, read, Placement::default)
        .unless_identity()
}

fn joints(cx: &mut Context, places: &mut Places, list: &Value) -> Option<Vec<Read>> {
    let Some(items) = list.as_array() else {
        cx.wanted(
            list,
            "[[joint]] tables",
            "write [[joint]], with two brackets",
        );
        return None;
    };
    if items.len() > Robot::MAX_JOINTS {
        let span = items.get(Robot::MAX_JOINTS).map_or(0..0, Context::span);
        let span = first_line(cx.source, span);
        let message = format!(
            "a robot has 1 to {} joints, not {}",
            Robot::MAX_JOINTS,
            items.len()
        );
        cx.sink.error(span, message, "this is the first too many");
    }
    let joints = items.iter().take(Robot::MAX_JOINTS).enumerate();
    Some(
        joints
            .filter_map(|(index, item)| {
                let table = cx.table(item, "each joint is a [[joint]] table")?;
                let keys = Keys {
                    table,
                    span: first_line(cx.source, Context::span(item)),
                    what: format!("joint {}", index + 1),
                };
                let (joint, placed) = joint::read(cx, places, &keys, index);
                let span = keys.span;
                Some(Read {
                    joint,
                    placed,
                    span,
                })
            })
            .collect(),
    )
}
