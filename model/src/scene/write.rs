//! The text of a scene: one for one scene, as for robots.

use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use super::{Float, Scene};
use crate::number::Rational;
use crate::robot::Position;
use crate::robot::values::{
    inertia, lines, list, number, position, quoted, short_hash, table, word,
};

/// Writes a scene as its table in a robot file, `[scene.NAME]`, joints by
/// number.
pub fn write(scene: &Scene) -> String {
    let mut text = format!("[scene.{}]\n", scene.name);
    let outputs = list(scene.outputs.iter().map(|o| format!("\"{}\"", o.text())));
    let numbers = |joints: &Vec<usize>| list(joints.iter().map(|j| (j + 1).to_string()));
    let mut locks: Vec<_> = scene.lock.iter().collect();
    locks.sort_by_key(|(joint, _)| *joint);
    let locks = locks
        .iter()
        .map(|(joint, at)| ((joint + 1).to_string(), position(at)));
    let locks: Vec<(String, String)> = locks.collect();
    let zero = |is_zero: bool| is_zero.then(|| quoted("zero"));
    let payload = scene.payload.as_ref().and_then(|payload| {
        table([
            ("mass", Some(number(&payload.mass))),
            ("com", Some(list(payload.com.each_ref().map(number)))),
            ("inertia", Some(inertia(&payload.inertia))),
        ])
    });
    let bounds = &scene.bounds;
    let range = |ends: &[Position; 2]| list(ends.each_ref().map(position));
    let ranges = |all: &Vec<[Position; 2]>| list(all.iter().map(range));
    let rates = |all: &Vec<Rational>| list(all.iter().map(number));
    let tolerance = scene.tolerance.as_ref().and_then(|tolerance| {
        let value = match tolerance.value.as_slice() {
            [one] => number(one),
            each => list(each.iter().map(number)),
        };
        let scale = quoted(tolerance.relative_to.word());
        table([("value", Some(value)), ("relative_to", Some(scale))])
    });
    let scalar = scene.scalar.as_ref();
    let scalar = scalar.map(|scalar| quoted(word(&Float::WORDS, scalar)));
    lines(
        &mut text,
        [
            ("outputs", (!scene.outputs.is_empty()).then_some(outputs)),
            ("joints", scene.joints.as_ref().map(numbers)),
            (
                "lock",
                table(
                    locks
                        .iter()
                        .map(|(joint, at)| (joint.as_str(), Some(at.clone()))),
                ),
            ),
            (
                "gravity",
                scene
                    .gravity
                    .as_ref()
                    .map(|g| list(g.each_ref().map(number))),
            ),
            ("velocity", zero(scene.velocity_zero)),
            ("acceleration", zero(scene.acceleration_zero)),
            ("payload", payload),
            (
                "box",
                table([
                    ("position", bounds.position.as_ref().map(ranges)),
                    ("velocity", bounds.velocity.as_ref().map(rates)),
                    ("acceleration", bounds.acceleration.as_ref().map(rates)),
                ]),
            ),
            ("tolerance", tolerance),
            ("scalar", scalar),
        ],
    );
    text
}

impl Scene {
    /// Returns the first 16 hexadecimal digits of the SHA-256 of the
    /// [written](write()) scene.
    pub fn short_hash(&self) -> String {
        short_hash(&write(self))
    }
}
