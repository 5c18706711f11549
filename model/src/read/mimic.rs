//! `mimic` of a joint: which other it follows, and along which line.

use alloc::format;
use alloc::string::ToString;
use alloc::vec::Vec;
use core::ops::Range;

use num_traits::{One, Signed, Zero};
use toml_span::Value;

use super::frame;
use super::table::Keys;
use super::value::{Context, first_line};
use crate::number::Rational;
use crate::robot::{Follower, Joint, JointKind, Position, Robot};

/// What `mimic` may say.
const KEYS: [&str; 3] = ["joint", "multiplier", "offset"];
/// How it is written.
const HELP: &str = "mimic = { joint = 2, multiplier = -1, offset = 0 }: q is multiplier times the \
                    position of that joint, plus offset";

/// What a joint follows, as the file has it.
pub(super) struct Mimic {
    leader: usize,
    multiplier: Rational,
    offset: Position,
    span: Range<usize>,
}

/// Reads what joints follow, each from its `mimic`; what cannot be read is reported and
/// left out.
pub(super) fn read(
    cx: &mut Context,
    joints: &[Joint],
    values: &[Option<&Value>],
) -> Vec<Option<Mimic>> {
    let values = values.iter().zip(joints).enumerate();
    values
        .map(|(row, (value, joint))| one(cx, joints, row, joint, (*value)?))
        .collect()
}

fn one(
    cx: &mut Context,
    joints: &[Joint],
    row: usize,
    joint: &Joint,
    value: &Value,
) -> Option<Mimic> {
    let span = first_line(cx.source, Context::span(value));
    let keys = Keys {
        table: cx.table(value, HELP)?,
        span: span.clone(),
        what: "mimic".to_string(),
    };
    keys.reject_unknown(&KEYS, cx.sink);
    let leader = keys.require("joint", HELP, cx.sink)?;
    let leader = frame::joint(cx, joints, leader, HELP)?;
    let multiplier = match keys.get("multiplier") {
        None => Rational::one(),
        Some(value) => cx.number(value)?,
    };
    let turns = joint.kind == JointKind::Revolute;
    let offset = match (keys.get("offset"), turns) {
        (None, true) => Position::Angle(Default::default()),
        (None, false) => Position::Length(Rational::zero()),
        (Some(value), true) => Position::Angle(cx.angle(value)?),
        (Some(value), false) => Position::Length(cx.length(value)?),
    };
    let most = Rational::from_integer(Follower::MAX_TURNS.into());
    let refusal = if leader == row {
        Some(("a joint that follows itself".to_string(), HELP.to_string()))
    } else if joints[leader].kind != joint.kind {
        Some((
            "one of both joints turns, and the other slides".to_string(),
            "a joint follows another of its own kind".to_string(),
        ))
    } else if multiplier.is_zero() {
        let help = "one that stands still is a part of its link";
        Some((
            "a multiplier of 0: the joint never moves".to_string(),
            help.to_string(),
        ))
    } else if turns && (!multiplier.is_integer() || multiplier.abs() > most) {
        Some((format!("a joint that turns {multiplier} times as far"), {
            let inverse = multiplier.recip();
            match inverse.is_integer() && inverse.abs() <= most {
                true => format!(
                    "sines are of whole multiples, up to {most}: let that joint mimic this one, \
                     with multiplier = {inverse}"
                ),
                false => format!("sines are of whole multiples of an angle, up to {most}"),
            }
        }))
    } else if joint.has_coulomb() {
        let help = "give it to the joint that leads, times the size of the multiplier";
        Some((
            "`coulomb` of a joint that follows another".to_string(),
            help.to_string(),
        ))
    } else {
        None
    };
    if let Some((message, help)) = refusal {
        cx.sink.error(span, message, &help);
        return None;
    }
    Some(Mimic {
        leader,
        multiplier,
        offset,
        span,
    })
}

/// Takes the joints of a robot that follow others out of its coordinates. One that
/// follows a follower follows the leader of that.
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
                let help = "let each follow the one that leads them all";
                cx.sink.error(mimic.span.clone(), message.to_string(), help);
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
    for own in robot.followers.clone() {
        let Some(leader) = robot.joints.get_mut(own.leader) else {
            continue;
        };
        if own.narrow(leader).is_none() {
            let mimic = mimics.get(own.row).and_then(Option::as_ref);
            let span = mimic.map_or(0..0, |mimic| mimic.span.clone());
            let message = "there is no position at which both are within their limits";
            let help = format!("{HELP}; look at `position` of both");
            cx.sink.error(span, message.to_string(), &help);
        }
    }
    robot
}
