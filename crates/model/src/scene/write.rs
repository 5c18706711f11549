//! The text of a scene: one for one scene, as for robots.

use alloc::borrow::ToOwned;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use super::{Scene, SceneScalar};
use crate::robot::Parent;
use crate::robot::values::{
    bodies, lines, list, number, numbers, position, quoted, range, short_hash, table, word,
};

/// Writes a scene as its table in a robot file, `[scene.NAME]`, joints by number.
pub fn write(scene: &Scene) -> String {
    let mut text = format!("[scene.{}]\n", scene.name);
    let outputs = list(scene.outputs.iter().map(|o| format!("\"{}\"", o.text())));
    let joints = |joints: &Vec<usize>| list(joints.iter().map(|j| (j + 1).to_string()));
    let mut locks: Vec<_> = scene.lock.iter().collect();
    locks.sort_by_key(|(joint, _)| *joint);
    let locks = locks
        .iter()
        .map(|(joint, at)| ((joint + 1).to_string(), Some(position(at))));
    let base = (scene.lock_base).then(|| (Parent::BASE.to_owned(), Some(quoted(Scene::LEVEL))));
    let locks: Vec<(String, Option<String>)> = base.into_iter().chain(locks).collect();
    let lock = locks.iter().map(|(joint, at)| (joint.as_str(), at.clone()));
    let zero = |is_zero: bool| is_zero.then(|| quoted("zero"));
    let payload = scene.payload.as_ref().and_then(|payload| {
        table([
            ("mass", Some(number(&payload.mass))),
            ("com", Some(numbers(&payload.com))),
            ("inertia", Some(numbers(payload.inertia.entries()))),
            (
                "link",
                scene.payload_link.map(|link| match link {
                    Parent::Base => quoted(Parent::BASE),
                    Parent::Row(row) => (row + 1).to_string(),
                }),
            ),
        ])
    });
    let bounds = &scene.bounds;
    let positions = bounds.position.as_ref();
    let bounds = table([
        (
            "position",
            positions.map(|ranges| list(ranges.iter().map(range))),
        ),
        ("velocity", bounds.velocity.as_ref().map(numbers)),
        ("acceleration", bounds.acceleration.as_ref().map(numbers)),
        ("payload", bounds.payload.as_ref().and_then(bodies)),
    ]);
    let tolerance = scene.tolerance.as_ref().and_then(|tolerance| {
        let value = match tolerance.value.as_slice() {
            [one] => number(one),
            tolerances => numbers(tolerances),
        };
        let scale = quoted(tolerance.relative_to.word());
        table([("value", Some(value)), ("relative_to", Some(scale))])
    });
    let scalar = scene.scalar.as_ref();
    let scalar = scalar.map(|scalar| quoted(word(&SceneScalar::WORDS, scalar)));
    lines(
        &mut text,
        [
            ("outputs", (!scene.outputs.is_empty()).then_some(outputs)),
            ("joints", scene.joints.as_ref().map(joints)),
            ("lock", table(lock)),
            ("gravity", scene.gravity.as_ref().map(numbers)),
            ("velocity", zero(scene.velocity_zero)),
            ("acceleration", zero(scene.acceleration_zero)),
            ("payload", payload),
            ("box", bounds),
            ("tolerance", tolerance),
            ("scalar", scalar),
        ],
    );
    text
}

impl Scene {
    /// Returns the first 16 hexadecimal digits of the SHA-256 of the [written](write()) scene.
    pub fn short_hash(&self) -> String {
        short_hash(&write(self))
    }
}
