//! Joints and links by their number or name.

use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use toml_span::Value;

use super::report::quote;
use super::suggest;
use super::value::Context;
use crate::robot::{Joint, Parent, Robot};

pub(super) fn read(cx: &mut Context, joints: &[Joint], value: &Value, help: &str) -> Option<usize> {
    let Some(text) = text_of(value) else {
        return cx.wanted(value, "a link", help);
    };
    let row = find(joints, &text);
    if row.is_none() {
        let message = format!("there is no link {}", quote(&text));
        let meant = meant(joints, &text);
        let help = format!("links have the names of their joints; {meant}");
        return cx.refuse(value, message, &help);
    }
    row
}

/// Returns true if a value names the base: by its name, where it floats.
pub(super) fn is_base(robot: &Robot, value: &Value) -> bool {
    (value.as_str()).is_some_and(|text| is_named_base(robot, text))
}

pub(super) fn is_named_base(robot: &Robot, text: &str) -> bool {
    let name = robot
        .floating
        .as_ref()
        .and_then(|base| base.name.as_deref());
    text == Parent::BASE || name == Some(text)
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
    match (text.parse::<i64>(), suggest::closest(text, &names)) {
        (Err(_), Some(meant)) => format!("did you mean `{meant}`?"),
        (Err(_), None) if names.is_empty() => {
            format!("the joints have no names: count them from 1 to {n}")
        }
        _ if names.is_empty() => format!("joints are counted from 1 to {n}"),
        _ => format!("joints are counted from 1 to {n}: {}", names.join(", ")),
    }
}
