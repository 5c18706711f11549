//! Joints and links by their number or name, and `parent` of a joint: the link that carries it.

use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use toml_span::Value;

use super::joint::Read;
use super::report::quote;
use super::value::Context;
use crate::diagnostic::closest;
use crate::robot::{Joint, Parent, Robot};

pub(super) fn read(cx: &mut Context, joints: &[Joint], value: &Value, help: &str) -> Option<usize> {
    let Some(text) = text_of(value) else {
        return cx.wanted(value, "a link", help);
    };
    find(joints, &text).or_else(|| {
        let message = format!("there is no link {}", quote(&text));
        let meant = meant(joints, &text);
        let help = format!("links have the names of their joints; {meant}");
        cx.refuse(value, message, &help)
    })
}

/// Returns true if a value names the base: by its name, where it floats.
pub(super) fn is_base(robot: &Robot, value: &Value) -> bool {
    (value.as_str()).is_some_and(|text| is_named_base(robot, text))
}

pub(super) fn is_named_base(robot: &Robot, text: &str) -> bool {
    let base = robot.floating.as_ref();
    text == Parent::BASE || base.is_some_and(|base| base.name.as_deref() == Some(text))
}

pub(super) fn text_of(value: &Value) -> Option<String> {
    let number = value.as_integer().map(|number| number.to_string());
    value.as_str().map(ToString::to_string).or(number)
}

pub(super) fn find(joints: &[Joint], text: &str) -> Option<usize> {
    match text.parse::<usize>() {
        Ok(number) => number.checked_sub(1).filter(|joint| *joint < joints.len()),
        Err(_) => {
            let mut names = joints.iter().map(|joint| joint.name.as_deref());
            names.position(|name| name == Some(text))
        }
    }
}

pub(super) fn meant(joints: &[Joint], text: &str) -> String {
    let n = joints.len();
    let names: Vec<&str> = joints.iter().filter_map(|j| j.name.as_deref()).collect();
    match (text.parse::<i64>(), closest(text, &names)) {
        (Err(_), Some(meant)) => format!("did you mean `{meant}`?"),
        (Err(_), None) if names.is_empty() => {
            format!("the joints have no names: count them from 1 to {n}")
        }
        _ if names.is_empty() => format!("joints are counted from 1 to {n}"),
        _ => format!("joints are counted from 1 to {n}: {}", names.join(", ")),
    }
}

/// Returns the parents that are not the link before.
pub(super) fn parents(cx: &mut Context, robot: &Robot, rows: &[Read]) -> Vec<Option<Parent>> {
    const HELP: &str =
        "parent = 2, or the name of the joint whose link carries this one; \"base\" for the base";
    // After a parent that cannot be read the robot counts as branched, so that its one error is
    // not followed by errors of a chain.
    let unknown = (rows.iter().any(|joint| joint.placed.is_some())).then_some(Parent::Base);
    let parents = rows.iter().enumerate().map(|(row, joint)| {
        let value = joint.parent?;
        if is_base(robot, value) {
            return (row > 0).then_some(Parent::Base);
        }
        let Some(parent) = read(cx, &robot.joints, value, HELP) else {
            return unknown.filter(|_| row > 0);
        };
        if parent >= row {
            let label = robot.joint_label(parent);
            let (message, help) = match parent == row {
                true => (format!("{label} carries itself"), HELP.into()),
                false => (
                    format!("{label}, which carries this joint, comes later"),
                    format!("put the [[joint]] table of {label} before this one"),
                ),
            };
            cx.refuse::<()>(value, message, &help);
            return unknown.filter(|_| row > 0);
        }
        (parent + 1 != row).then_some(Parent::Row(parent))
    });
    parents.collect()
}
