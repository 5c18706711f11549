//! The text of a scene: one for one scene, as for robots.

use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use core::fmt::Write;

use super::{Float, Scene};
use crate::robot::values::{list, number, position};

/// Writes a scene as its table in a robot file, `[scene.NAME]`, joints by
/// number.
pub fn write(scene: &Scene) -> String {
    let mut text = format!("[scene.{}]\n", scene.name);
    // Writing to a string cannot fail.
    let mut line = |key: &str, value: &str| {
        let _ = writeln!(text, "{key} = {value}");
    };
    if !scene.outputs.is_empty() {
        let outputs = scene.outputs.iter().map(|o| format!("\"{}\"", o.text()));
        line("outputs", &list(outputs));
    }
    if let Some(joints) = &scene.joints {
        line("joints", &list(joints.iter().map(|j| (j + 1).to_string())));
    }
    if !scene.lock.is_empty() {
        let mut locks: Vec<_> = scene.lock.iter().collect();
        locks.sort_by_key(|(joint, _)| *joint);
        let locks: Vec<String> = locks
            .iter()
            .map(|(joint, at)| format!("{} = {}", joint + 1, position(at)))
            .collect();
        line("lock", &format!("{{ {} }}", locks.join(", ")));
    }
    if let Some(gravity) = &scene.gravity {
        line("gravity", &list(gravity.iter().map(number)));
    }
    for (key, zero) in [
        ("velocity", scene.velocity_zero),
        ("acceleration", scene.acceleration_zero),
    ] {
        if zero {
            line(key, "\"zero\"");
        }
    }
    if let Some(payload) = &scene.payload {
        let i = &payload.inertia;
        let inertia = [&i.xx, &i.yy, &i.zz, &i.xy, &i.yz, &i.xz];
        let value = format!(
            "{{ mass = {}, com = {}, inertia = {} }}",
            number(&payload.mass),
            list(payload.com.iter().map(number)),
            list(inertia.into_iter().map(number))
        );
        line("payload", &value);
    }
    let mut parts = Vec::new();
    if let Some(ranges) = &scene.bounds.position {
        let ranges = ranges.iter().map(|range| list(range.iter().map(position)));
        parts.push(format!("position = {}", list(ranges)));
    }
    for (key, values) in [
        ("velocity", &scene.bounds.velocity),
        ("acceleration", &scene.bounds.acceleration),
    ] {
        if let Some(values) = values {
            parts.push(format!("{key} = {}", list(values.iter().map(number))));
        }
    }
    if !parts.is_empty() {
        line("box", &format!("{{ {} }}", parts.join(", ")));
    }
    if let Some(tolerance) = &scene.tolerance {
        let value = match tolerance.value.as_slice() {
            [one] => number(one),
            each => list(each.iter().map(number)),
        };
        let scale = tolerance.relative_to.word();
        line(
            "tolerance",
            &format!("{{ value = {value}, relative_to = \"{scale}\" }}"),
        );
    }
    match scene.scalar {
        Some(Float::F64) => line("scalar", "\"f64\""),
        Some(Float::F32) => line("scalar", "\"f32\""),
        None => {}
    }
    text
}

impl Scene {
    /// Returns the first 16 hexadecimal digits of the SHA-256 of the
    /// [written](write()) scene.
    pub fn short_hash(&self) -> String {
        let mut text = String::new();
        for byte in &hmac_sha256::Hash::hash(write(self).as_bytes())[..8] {
            // Writing to a string cannot fail.
            let _ = write!(text, "{byte:02x}");
        }
        text
    }
}
