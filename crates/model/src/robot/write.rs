//! The robot file that says exactly what a [`Robot`] says, and its hash.
//!
//! There is one text for one robot: keys in a fixed order, values that equal their default left
//! out, numbers in one form. So the text can stand for the robot wherever two robots are compared.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use super::values::{
    angle, bodies, lines, list, number, numbers, parent, placement, position, quoted, range,
    short_hash, table, texts, unless_zero, word,
};
use super::{Convention, FloatingBase, Joint, JointKind, Parent, Placed, Placement, Robot};
use crate::number::Rational;

/// Writes a robot as a robot file.
///
/// Numbers that have no decimal, like 1/3, become strings, `"1/3"`. Reading the text gives the same
/// robot with angles in [canonical](crate::number::Angle::canonical) form, but one of radians that
/// [counts as](crate::number::SnappedAngle::Taken) a multiple of π/2 becomes that.
pub fn write(robot: &Robot) -> String {
    let mut text = String::new();
    let convention = word(&Convention::WORDS, &robot.convention);
    let head = [
        ("name", Some(quoted(&robot.name))),
        ("convention", (!robot.is_tree()).then(|| quoted(convention))),
        ("gravity", Some(numbers(&robot.gravity))),
    ];
    lines(&mut text, head);
    let written = |(key, value): (_, Option<&Placement>)| (key, value.map(placement));
    lines(&mut text, robot.placements().map(written));
    let limits = table([("payload", robot.payload_range.as_ref().and_then(bodies))]);
    lines(&mut text, [("limits", limits)]);
    lines(&mut text, [("notes", texts(&robot.notes))]);
    if let Some(base) = &robot.floating {
        text.push_str("\n[[joint]]\n");
        write_base(&mut text, base);
    }
    for (row, joint) in robot.rows().into_iter().enumerate() {
        text.push_str("\n[[joint]]\n");
        write_joint(&mut text, joint);
        if let Some(follower) = robot.followers.iter().find(|follower| follower.row == row) {
            let leader = robot.row_of(follower.leader) + 1;
            let mimic = table([
                ("joint", Some(format!("{leader}"))),
                ("multiplier", Some(number(&follower.multiplier))),
                ("offset", Some(position(&follower.offset))),
            ]);
            lines(&mut text, [("mimic", mimic)]);
        }
    }
    for frame in &robot.frames {
        text.push_str("\n[[frame]]\n");
        let link = parent(frame.row.map_or(Parent::Base, Parent::Row));
        let head = [("name", Some(quoted(&frame.name))), ("link", Some(link))];
        lines(&mut text, head);
        write_frame(&mut text, &frame.placement);
    }
    text
}

impl Robot {
    /// SHA-256 of the [written](write()) robot but its notes: equal exactly if all parameters are.
    pub fn input_hash(&self) -> [u8; 32] {
        hmac_sha256::Hash::hash(self.without_notes().as_bytes())
    }

    /// Returns the first 16 hexadecimal digits of [`Robot::input_hash`], for headers.
    pub fn short_hash(&self) -> String {
        short_hash(&self.without_notes())
    }

    fn without_notes(&self) -> String {
        write(&Robot {
            notes: Vec::new(),
            ..self.clone()
        })
    }
}

fn write_base(text: &mut String, base: &FloatingBase) {
    let six = |limit: &Option<[Rational; 6]>| limit.as_ref().map(numbers);
    let limits = table([
        ("velocity", six(&base.limits.velocity)),
        ("acceleration", six(&base.limits.acceleration)),
        ("torque", six(&base.limits.torque)),
        ("body", base.limits.body.as_ref().and_then(bodies)),
    ]);
    let keys = [
        ("name", base.name.as_deref().map(quoted)),
        ("kind", Some(quoted(FloatingBase::KIND))),
        ("mass", Some(number(&base.mass))),
        ("com", Some(numbers(&base.com))),
        ("inertia", Some(numbers(base.inertia.entries()))),
        ("limits", limits),
    ];
    lines(text, keys);
}

fn write_joint(text: &mut String, joint: &Joint) {
    let zero = || String::from("0");
    let place = joint.place.as_ref();
    let placed = |placed: &Placed| match placed.placement.is_identity() {
        true => String::from("{}"),
        false => placement(&placed.placement),
    };
    let (d, theta, offset) = match joint.kind {
        JointKind::Revolute => (number(&joint.d), zero(), angle(&joint.theta)),
        JointKind::Prismatic => (zero(), angle(&joint.theta), number(&joint.d)),
    };
    let limits = &joint.limits;
    let limits = table([
        ("position", limits.position.as_ref().map(range)),
        ("velocity", limits.velocity.as_ref().map(number)),
        ("acceleration", limits.acceleration.as_ref().map(number)),
        ("torque", limits.torque.as_ref().map(number)),
        ("body", limits.body.as_ref().and_then(bodies)),
    ]);
    let keys = [
        ("name", joint.name.as_deref().map(quoted)),
        ("parent", joint.parent.map(parent)),
        ("kind", Some(quoted(word(&JointKind::WORDS, &joint.kind)))),
        ("placement", place.map(placed)),
        ("axis", place.map(|placed| numbers(&placed.axis))),
        ("alpha", unless_zero(angle(&joint.alpha))),
        ("beta", unless_zero(angle(&joint.beta))),
        ("a", unless_zero(number(&joint.a))),
        ("d", unless_zero(d)),
        ("theta", unless_zero(theta)),
        ("offset", unless_zero(offset)),
        ("mass", Some(number(&joint.mass))),
        ("com", Some(numbers(&joint.com))),
        ("inertia", Some(numbers(joint.inertia.entries()))),
        ("viscous", unless_zero(number(&joint.viscous))),
        ("coulomb", unless_zero(number(&joint.coulomb))),
        ("coulomb_width", unless_zero(number(&joint.coulomb_width))),
        ("armature", unless_zero(number(&joint.armature))),
        ("frame", joint.frame.as_ref().map(placement)),
        ("limits", limits),
    ];
    lines(text, keys);
}

/// Writes the keys of a `[[frame]]` table that say where it is.
pub fn write_frame(text: &mut String, Placement { xyz, rpy }: &Placement) {
    let moves = xyz.iter().any(|x| !num_traits::Zero::is_zero(x));
    let turns = rpy.iter().any(|turn| !turn.is_zero());
    let xyz = moves.then(|| numbers(xyz));
    let rpy = turns.then(|| list(rpy.iter().map(angle)));
    lines(text, [("xyz", xyz), ("rpy", rpy)]);
}
