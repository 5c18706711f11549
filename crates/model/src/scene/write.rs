//! The text of a scene: one for one scene, as for robots.

use alloc::borrow::ToOwned;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use super::{Scene, SceneScalar};
use crate::robot::values::{
    bodies, lines, list, number, numbers, parent, position, quoted, range, short_hash, table, word,
};
use crate::robot::{Parent, Position};

/// Writes a scene as its table in a robot file, `[scene.NAME]`, joints by number.
pub fn write(scene: &Scene) -> String {
    let mut text = format!("[scene.{}]\n", scene.name);
    let outputs = list(scene.outputs.iter().map(|o| format!("\"{}\"", o.text())));
    let joints = |joints: &Vec<usize>| list(joints.iter().map(|j| (j + 1).to_string()));
    let mut locks: Vec<_> = scene.lock.iter().collect();
    locks.sort_by_key(|(joint, _)| *joint);
    let of_joint = |(joint, at): &(usize, _)| ((joint + 1).to_string(), Some(position(at)));
    let of_joints = locks.into_iter().map(of_joint);
    let base = (scene.lock_base).then(|| (Parent::BASE.to_owned(), Some(quoted(Scene::LEVEL))));
    let keys: Vec<_> = base.into_iter().chain(of_joints).collect();
    let lock = keys.iter().map(|(joint, at)| (joint.as_str(), at.clone()));
    let zero = |is_zero: bool| is_zero.then(|| quoted("zero"));
    let payload = scene.payload.as_ref().and_then(|payload| {
        table([
            ("mass", Some(number(&payload.mass))),
            ("com", Some(numbers(&payload.com))),
            ("inertia", Some(numbers(payload.inertia.entries()))),
            ("link", scene.payload_link.map(parent)),
        ])
    });
    let bounds = &scene.bounds;
    let ranges = |ranges: &Vec<[Position; 2]>| list(ranges.iter().map(range));
    let bounds = table([
        ("position", bounds.position.as_ref().map(ranges)),
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
    let keys = [
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
    ];
    lines(&mut text, keys);
    text
}

impl Scene {
    /// Returns the first 16 hexadecimal digits of the SHA-256 of the [written](write()) scene.
    pub fn short_hash(&self) -> String {
        short_hash(&write(self))
    }
}
