//! The robot file that says exactly what a [`Robot`] says, and its hash.
//!
//! There is one text for one robot: keys in a fixed order, values that equal
//! their default left out, numbers in one form. So the text can stand for the
//! robot wherever two robots are compared.

use alloc::format;
use alloc::string::String;
use core::fmt::Write;

use num_traits::Zero;

use super::values::{angle, list, number, placement, position, quoted};
use super::{Convention, Joint, JointKind, Placement, Robot};
use crate::number::{Angle, Rational};

/// Writes a robot as a robot file.
///
/// Numbers that have no decimal, like 1/3, become strings, `"1/3"`, which the
/// reader takes too. Reading the text gives the same robot with angles in
/// [canonical](Angle::canonical) form; a number of radians next to a multiple
/// of π/2 needs [`Snap::Never`](crate::number::Snap::Never) for that.
pub fn write(robot: &Robot) -> String {
    let mut text = String::new();
    let [x, y, z] = &robot.gravity;
    line(&mut text, "name", &quoted(&robot.name));
    let convention = match robot.convention {
        Convention::Standard => "\"standard\"",
        Convention::Modified => "\"modified\"",
    };
    line(&mut text, "convention", convention);
    line(&mut text, "gravity", &list([x, y, z].map(number)));
    for (key, value) in robot.placements() {
        if let Some(value) = value {
            line(&mut text, key, &placement(value));
        }
    }
    for (row, joint) in robot.rows().into_iter().enumerate() {
        text.push_str("\n[[joint]]\n");
        write_joint(&mut text, joint);
        if let Some(own) = robot.followers.iter().find(|own| own.row == row) {
            let leader = robot.row_of(own.leader) + 1;
            let (by, at) = (number(&own.multiplier), position(&own.offset));
            let line_of = format!("{{ joint = {leader}, multiplier = {by}, offset = {at} }}");
            line(&mut text, "mimic", &line_of);
        }
    }
    for frame in &robot.frames {
        text.push_str("\n[[frame]]\n");
        line(&mut text, "name", &quoted(&frame.name));
        line(&mut text, "link", &format!("{}", frame.joint + 1));
        write_frame(&mut text, &frame.placement);
    }
    text
}

impl Robot {
    /// SHA-256 of the [written](write()) robot: equal exactly if every
    /// parameter is, names and limits included.
    pub fn input_hash(&self) -> [u8; 32] {
        hmac_sha256::Hash::hash(write(self).as_bytes())
    }

    /// Returns the first 16 hexadecimal digits of [`Robot::input_hash`], for headers.
    pub fn short_hash(&self) -> String {
        let mut text = String::new();
        for byte in &self.input_hash()[..8] {
            // Writing to a string cannot fail.
            let _ = write!(text, "{byte:02x}");
        }
        text
    }
}

fn write_joint(text: &mut String, joint: &Joint) {
    if let Some(name) = &joint.name {
        line(text, "name", &quoted(name));
    }
    let zero = Rational::zero();
    let none = Angle::default();
    // What the file calls offset is the constant part of the variable.
    let (kind, d, theta, offset) = match joint.kind {
        JointKind::Revolute => ("\"revolute\"", &joint.d, &none, angle(&joint.theta)),
        JointKind::Prismatic => ("\"prismatic\"", &zero, &joint.theta, number(&joint.d)),
    };
    line(text, "kind", kind);
    for (key, value) in [
        ("alpha", angle(&joint.alpha)),
        ("beta", angle(&joint.beta)),
        ("a", number(&joint.a)),
        ("d", number(d)),
        ("theta", angle(theta)),
        ("offset", offset),
    ] {
        if value != "0" {
            line(text, key, &value);
        }
    }
    line(text, "mass", &number(&joint.mass));
    let [x, y, z] = &joint.com;
    line(text, "com", &list([x, y, z].map(number)));
    let i = &joint.inertia;
    line(
        text,
        "inertia",
        &list([&i.xx, &i.yy, &i.zz, &i.xy, &i.yz, &i.xz].map(number)),
    );
    for (key, value) in [
        ("viscous", &joint.viscous),
        ("coulomb", &joint.coulomb),
        ("coulomb_width", &joint.coulomb_width),
        ("armature", &joint.armature),
    ] {
        if !value.is_zero() {
            line(text, key, &number(value));
        }
    }
    if let Some(frame) = &joint.frame {
        line(text, "frame", &placement(frame));
    }
    write_limits(text, joint);
}

/// Writes the keys of a `[[frame]]` table that say where it is.
pub fn write_frame(text: &mut String, placement: &Placement) {
    if placement.xyz.iter().any(|x| !x.is_zero()) {
        line(text, "xyz", &list(placement.xyz.iter().map(number)));
    }
    if placement.rpy.iter().any(|turn| !turn.is_zero()) {
        line(text, "rpy", &list(placement.rpy.iter().map(angle)));
    }
}

fn write_limits(text: &mut String, joint: &Joint) {
    let limits = &joint.limits;
    let mut parts = String::new();
    let mut part = |key: &str, value: &str| {
        let comma = if parts.is_empty() { "" } else { ", " };
        parts.push_str(comma);
        parts.push_str(key);
        parts.push_str(" = ");
        parts.push_str(value);
    };
    if let Some([low, high]) = &limits.position {
        part(
            "position",
            &format!("[{}, {}]", position(low), position(high)),
        );
    }
    for (key, value) in [
        ("velocity", &limits.velocity),
        ("acceleration", &limits.acceleration),
        ("torque", &limits.torque),
    ] {
        if let Some(value) = value {
            part(key, &number(value));
        }
    }
    if !parts.is_empty() {
        line(text, "limits", &format!("{{ {parts} }}"));
    }
}

fn line(text: &mut String, key: &str, value: &str) {
    text.push_str(key);
    text.push_str(" = ");
    text.push_str(value);
    text.push('\n');
}
