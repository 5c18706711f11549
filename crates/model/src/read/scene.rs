//! The `[scene.NAME]` tables.

use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use core::ops::Range;

use toml_span::Value;

use super::link;
use super::report::quote;
use super::table::{Table, locate};
use super::value::{Context, bodies, bytes_of};
use crate::robot::{Follower, Joint, JointKind, Parent, Position, Robot};
use crate::scene::{MotionBox, Payload, Scale, Scene, SceneScalar, Tolerance};

pub(super) fn read(cx: &mut Context, robot: &Robot, root: &Value, scenes: &Value) -> Vec<Scene> {
    const HELP: &str = "each scene is a [scene.NAME] table";
    let Some(table) = Table::open(cx, scenes, "scene", "scene", HELP) else {
        return Vec::new();
    };
    let mut read = Vec::new();
    for (key, value) in table.entries() {
        let place = format!("scene/{}", key.name);
        let name = format!("scene {}", quote(&key.name));
        let Some(mut keys) = Table::open(cx, value, place, name, HELP) else {
            continue;
        };
        keys.span = bytes_of(key.span);
        let scene = scene(cx, robot, &key.name, &mut keys);
        for finding in scene.validate(robot) {
            let suffix = finding.keys().strip_prefix(&keys.place);
            let inner_place = suffix.map(|suffix| suffix.trim_start_matches('/'));
            // A limit that a tolerance seems to lack may be one that cannot be read.
            let is_lack = inner_place == Some("tolerance") && !cx.unread.is_empty();
            if is_lack || cx.is_unread(finding.keys()) {
                continue;
            }
            let (value, place) = match inner_place {
                Some(inner_place) => (value, inner_place),
                None => (root, finding.keys()),
            };
            let span = locate(value, bytes_of(key.span), &cx.sink.source, place);
            cx.sink.place(finding, span);
        }
        keys.finish(cx);
        read.push(scene);
    }
    read
}

fn scene(cx: &mut Context, robot: &Robot, name: &str, keys: &mut Table) -> Scene {
    const JOINTS: &str = "joints = [1, 2, \"elbow\"]: numbers from 1, or names";
    const GRAVITY: &str = "gravity = [0, 0, -9.81], or [0, 0, 0] for none";
    let outputs = keys.optional(cx, "outputs", |cx, value| cx.outputs(value, "a scene"));
    let (payload, payload_link) = payload(cx, robot, keys).unzip();
    let (lock_base, lock) = lock(cx, robot, keys).unwrap_or_default();
    Scene {
        name: name.to_string(),
        outputs: outputs.unwrap_or_default(),
        joints: keys.optional(cx, "joints", |cx, value| {
            let items = cx.list(value, "a list", JOINTS)?;
            cx.each(items, |cx, _, item| match link::text_of(item) {
                Some(text) => joint(cx, robot, &text, item.span.into()),
                None => cx.wanted(item, "a joint", JOINTS),
            })
        }),
        lock_base,
        lock,
        gravity: keys.optional(cx, "gravity", |cx, value| {
            cx.array(value, GRAVITY, Context::number)
        }),
        velocity_zero: zero(cx, keys, "velocity"),
        acceleration_zero: zero(cx, keys, "acceleration"),
        payload,
        payload_link: payload_link.flatten(),
        bounds: bounds(cx, robot, keys).unwrap_or_default(),
        tolerance: tolerance(cx, keys),
        scalar: keys.optional(cx, "scalar", |cx, value| {
            cx.word(value, &SceneScalar::WORDS, "")
        }),
    }
}

fn joint(cx: &mut Context, robot: &Robot, text: &str, span: Range<usize>) -> Option<usize> {
    let row = link::find(&robot.joints, text);
    if row.is_some() {
        return row;
    }
    let is_named = |follower: &&Follower| follower.joint.name.as_deref() == Some(text);
    let (mut message, mut help) = (
        format!("there is no joint {}", quote(text)),
        link::meant(&robot.joints, text),
    );
    if let Some(follower) = robot.followers.iter().find(is_named) {
        let leader = robot.joint_label(follower.leader);
        message = format!("joint {} follows another", quote(text));
        help = format!("name {leader}, by which it moves");
    }
    cx.sink.error(span, message, &help);
    None
}

fn kind(robot: &Robot, joint: usize) -> Option<JointKind> {
    Some(robot.joints.get(joint)?.kind)
}

/// Returns true if the base is locked, and the joints that are, with their positions.
fn lock(
    cx: &mut Context,
    robot: &Robot,
    keys: &mut Table,
) -> Option<(bool, Vec<(usize, Position)>)> {
    let place = keys.place_of("lock");
    keys.optional(cx, "lock", |cx, value| {
        let text = value.as_str();
        let named = text.and_then(|text| link::find(&robot.joints, text));
        let row = named.unwrap_or(robot.joints.len().saturating_sub(1));
        let plain = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
        let is_plain = |name: &&String| name.chars().all(plain);
        let joint_name = robot.joints.get(row).and_then(|joint| joint.name.as_ref());
        let name = joint_name.filter(is_plain).cloned();
        let help = format!(
            "lock = {{ {} = 0 }}: each joint, by its name or number, with its position",
            name.unwrap_or_else(|| (row + 1).to_string())
        );
        let table = Table::open(cx, value, place, "lock", &help)?;
        let (mut locks, mut lock_base) = (Vec::new(), false);
        for (key, value) in table.entries() {
            if robot.floating.is_some() && link::is_named_base(robot, &key.name) {
                let help = format!(
                    "lock = {{ {} = \"level\" }} holds the base; if it is tilted, give the scene \
                     its `gravity` in the base's axes",
                    key.name
                );
                lock_base |= cx.word(value, &[(Scene::LEVEL, ())], &help).is_some();
                continue;
            }
            let joint = joint(cx, robot, &key.name, bytes_of(key.span));
            let at = joint.and_then(|joint| cx.position(value, kind(robot, joint)));
            locks.push(joint.zip(at));
        }
        Some((lock_base, locks.into_iter().collect::<Option<_>>()?))
    })
}

fn zero(cx: &mut Context, keys: &mut Table, key: &'static str) -> bool {
    let help = format!(
        "{key} = \"zero\" for an arm without any; a range goes into the box: box = {{ {key} = [1, …] }}"
    );
    let read = keys.optional(cx, key, |cx, value| cx.word(value, &[("zero", ())], &help));
    read.is_some()
}

fn payload(cx: &mut Context, robot: &Robot, keys: &mut Table) -> Option<(Payload, Option<Parent>)> {
    const HELP: &str = "payload = { mass = 2.5, com = [0, 0, 0.05], inertia = [0.01, 0.01, 0.01, 0, 0, 0] }, in the last link's frame; `link = \"left_hand\"` names another where links branch";
    const COM: &str = "com = [x, y, z], in the frame of the last link, m";
    let rows: Vec<Joint> = robot.rows().into_iter().cloned().collect();
    keys.table(cx, "payload", HELP, |cx, keys| {
        let mass = keys.required(cx, "mass", HELP, Context::number);
        let com = keys.required(cx, "com", COM, |cx, value| {
            cx.array(value, COM, Context::number)
        });
        // Without an inertia it is a point mass.
        let inertia = keys.optional(cx, "inertia", Context::inertia);
        let link = keys.optional(cx, "link", |cx, value| match link::is_base(robot, value) {
            true => Some(Parent::Base),
            false => link::read(cx, &rows, value, HELP).map(Parent::Row),
        });
        let payload = Payload {
            mass: mass?,
            com: com?,
            inertia: inertia.unwrap_or_default(),
        };
        Some((payload, link))
    })
}

fn bounds(cx: &mut Context, robot: &Robot, keys: &mut Table) -> Option<MotionBox> {
    const HELP: &str =
        "box = { position = [[-3.1, 3.1], …], velocity = [2, …], acceleration = [10, …] }";
    keys.table(cx, "box", HELP, |cx, keys| {
        Some(MotionBox {
            position: each(cx, keys, "position", |cx, joint, value| {
                cx.range(value, kind(robot, joint), "[lowest, highest]")
            }),
            velocity: each(cx, keys, "velocity", |cx, coordinate, value| {
                cx.rate(value, robot.turns(coordinate), "rad/s")
            }),
            acceleration: each(cx, keys, "acceleration", |cx, coordinate, value| {
                cx.rate(value, robot.turns(coordinate), "rad/s²")
            }),
            payload: bodies(cx, keys, "payload"),
        })
    })
}

fn each<T>(
    cx: &mut Context,
    keys: &mut Table,
    key: &'static str,
    read: impl FnMut(&mut Context, usize, &Value) -> Option<T>,
) -> Option<Vec<T>> {
    keys.optional(cx, key, |cx, value| {
        let items = cx.list(value, "a list", "one entry a joint")?;
        cx.each(items, read)
    })
}

fn tolerance(cx: &mut Context, keys: &mut Table) -> Option<Tolerance> {
    const HELP: &str = "tolerance = { value = 1e-3, relative_to = \"actuator\" }";
    const SCALE: &str = "relative_to = \"actuator\" (torque limits) or \"range\" (the largest torque that was found of the model)";
    keys.table(cx, "tolerance", HELP, |cx, keys| {
        let value = keys.required(cx, "value", HELP, |cx, value| match value.as_array() {
            Some(items) => cx.each(items, |cx, _, item| cx.part(item)),
            None => cx.part(value).map(|one| [one].into()),
        });
        let scale = keys.required(cx, "relative_to", SCALE, |cx, value| {
            cx.word(value, &Scale::WORDS, "")
        });
        Some(Tolerance {
            value: value?,
            relative_to: scale?,
        })
    })
}
