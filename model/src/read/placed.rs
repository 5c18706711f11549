//! Joints that are placed instead of having rows: all of them, or none.

use alloc::format;
use alloc::string::ToString;
use alloc::vec::Vec;
use core::ops::Range;

use toml_span::Value;

use super::places::Places;
use super::value::Context;
use crate::placed::{Placed, derive};
use crate::robot::{Convention, Field, Finding, Place, Placement, Robot, Severity};

/// Returns the convention where joints are placed: rows that are derived have one.
pub(super) fn convention(cx: &mut Context, value: Option<&Value>) -> Convention {
    let given = value.and_then(|value| cx.word(value, &Convention::WORDS).zip(Some(value)));
    if let Some((Convention::Modified, value)) = given {
        let message = "joints that are placed have rows of the standard convention".to_string();
        let help = "leave `convention` out: it says how rows are meant, and there are none";
        cx.sink.error(Context::span(value), message, help);
    }
    Convention::Standard
}

/// Gives a robot its rows where all joints are placed; what is placed only in
/// part is refused, with the joints' places in the file. Returns what is wrong or odd
/// about the robot: of joints that are placed, about what the file says of them.
pub(super) fn rows(
    cx: &mut Context,
    places: &Places,
    robot: &mut Robot,
    joints: Vec<(Option<Placed>, Range<usize>)>,
) -> Vec<Finding> {
    let placed = joints.iter().any(|(placed, _)| placed.is_some());
    let mut all = Vec::with_capacity(joints.len());
    for (index, (joint, span)) in joints.into_iter().enumerate() {
        match joint {
            Some(joint) => all.push(joint),
            None if placed => {
                let message = format!("joint {} is not placed, and others are", index + 1);
                let help = "give all joints a placement and an axis, or all of them DH rows";
                cx.sink.error(span, message, help);
            }
            None => {}
        }
    }
    let read = |index: usize| places.was_read(Place::Joint(index, Field::Placement));
    let ends = robot.placements().map(|(place, ..)| place);
    let ends = ends.into_iter().all(|place| places.was_read(place));
    let whole = !all.is_empty() && all.len() == robot.joints.len();
    if !whole || !ends || !(0..all.len()).all(read) {
        return robot.validate();
    }
    let placements: Vec<Placement> = all.iter().map(|own| own.placement.clone()).collect();
    let mut findings = robot.validate_placed(&placements);
    let is_error = |finding: &Finding| finding.severity == Severity::Error;
    // Directions of length zero were refused where they stand, and then there is an
    // error already. What is odd about a row that follows says nothing of the file.
    if derive(robot, &all).is_ok() && !findings.iter().any(is_error) {
        findings.extend(robot.validate().into_iter().filter(is_error));
    }
    findings
}
