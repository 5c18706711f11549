//! `mimic` of a joint: which other it follows, and along which line.

use alloc::format;
use alloc::vec::Vec;

use num_traits::{One, Signed, Zero};
use toml_span::Value;

use super::table::Table;
use super::value::Context;
use super::{joint, link};
use crate::number::Rational;
use crate::robot::{Follower, Joint, JointKind, Position, Robot};

const HELP: &str = "mimic = { joint = 2, multiplier = -1, offset = 0 }: q is multiplier times the \
                    position of that joint, plus offset";

pub(super) struct Mimic<'v> {
    leader: usize,
    multiplier: Rational,
    offset: Position,
    value: &'v Value<'v>,
}

pub(super) fn read<'v>(
    cx: &mut Context,
    joints: &[Joint],
    read: &[joint::Read<'v>],
) -> Vec<Option<Mimic<'v>>> {
    let rows = read.iter().enumerate();
    let mimics = rows.map(|(row, read)| one(cx, joints, row, read.mimic?));
    mimics.collect()
}

fn one<'v>(
    cx: &mut Context,
    joints: &[Joint],
    row: usize,
    value: &'v Value<'v>,
) -> Option<Mimic<'v>> {
    let joint = &joints[row];
    let turns = joint.kind == JointKind::Revolute;
    let mut keys = Table::open(cx, value, "mimic", "mimic", HELP)?;
    let leader = keys.required(cx, "joint", HELP, |cx, value| {
        link::read(cx, joints, value, HELP)
    });
    let multiplier = match keys.get("multiplier") {
        None => Some(Rational::one()),
        Some(value) => cx.number(value),
    };
    let offset = match keys.get("offset") {
        None if turns => Some(Position::Angle(Default::default())),
        None => Some(Position::Length(Rational::zero())),
        Some(value) => cx.position(value, Some(joint.kind)),
    };
    keys.finish(cx);
    let (leader, multiplier, offset) = (leader?, multiplier?, offset?);
    let most = Rational::from_integer(Follower::MAX_TURNS.into());
    let is_whole = |number: &Rational| number.is_integer() && number.abs() <= most;
    if leader == row {
        return cx.refuse(value, "the joint follows itself", HELP);
    }
    if joints[leader].kind != joint.kind {
        let message = "one of the two joints turns and the other slides";
        return cx.refuse(value, message, "a joint follows another of its own kind");
    }
    if multiplier.is_zero() {
        let help = "leave it out: a joint that never moves is part of its link";
        return cx.refuse(value, "a multiplier of 0: the joint never moves", help);
    }
    if turns && !is_whole(&multiplier) {
        let inverse = multiplier.recip();
        let help = match is_whole(&inverse) {
            true => format!(
                "sines are of whole multiples, up to {most}: let that joint mimic this one, \
                 with multiplier = {inverse}"
            ),
            false => format!("sines are of whole multiples of an angle, up to {most}"),
        };
        let message = format!("a joint that turns {multiplier} times as far");
        return cx.refuse(value, message, &help);
    }
    if joint.has_coulomb() {
        let help = "give it to the leading joint, times the absolute value of the multiplier";
        return cx.refuse(value, "`coulomb` of a joint that follows another", help);
    }
    Some(Mimic {
        leader,
        multiplier,
        offset,
        value,
    })
}

/// A joint that follows a follower follows the leader of that.
pub(super) fn split(cx: &mut Context, robot: Robot, mimics: &[Option<Mimic>]) -> Robot {
    let mut followers = Vec::new();
    for (row, mimic) in mimics.iter().enumerate() {
        let (Some(mimic), Some(joint)) = (mimic, robot.joints.get(row)) else {
            continue;
        };
        let (mut leader, mut multiplier) = (mimic.leader, mimic.multiplier.clone());
        let mut offset = mimic.offset.clone();
        let mut steps = 0;
        while let Some(Some(next)) = mimics.get(leader) {
            steps += 1;
            let added = next.offset.scaled(&multiplier).plus(&offset);
            let Some(added) = added.filter(|_| steps <= mimics.len()) else {
                let message = match steps > mimics.len() {
                    true => "joints that follow each other in a circle",
                    false => "an offset in radians on one that is a part of π",
                };
                let help = "let each joint follow the leading joint directly";
                cx.refuse::<()>(mimic.value, message, help);
                return robot;
            };
            offset = added;
            multiplier *= &next.multiplier;
            leader = next.leader;
        }
        followers.push(Follower {
            row,
            leader,
            multiplier,
            offset,
            joint: joint.clone(),
        });
    }
    let mut robot = robot.with_followers(followers);
    for follower in robot.followers.clone() {
        let Some(leader) = robot.joints.get_mut(follower.leader) else {
            continue;
        };
        if let (None, Some(Some(mimic))) = (follower.narrow(leader), mimics.get(follower.row)) {
            let message = "there is no position at which both are within their limits";
            let help = format!("{HELP}; look at `position` of both");
            cx.refuse::<()>(mimic.value, message, &help);
        }
    }
    robot
}
