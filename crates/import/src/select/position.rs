//! Positions of held joints, checked against their limits.

use std::cmp::Ordering;
use std::fmt::Display;

use dalembert_model::number::parse::parse_decimal;
use dalembert_model::number::{Angle, SnappedAngle};
use dalembert_model::robot::Position;

use crate::meant::meant;
use crate::model::{Joint, Kind, Value};
use crate::problems::Problems;

/// Returns the position that a text gives, or the nearest limit.
pub(crate) fn nearest(joint: &Joint, text: &str, problems: &mut Problems) -> Option<Position> {
    let at = read(joint, text, problems)?;
    let limit = beyond(joint, &at).map(|limit| limit.value.clone());
    Some(limit.unwrap_or(at))
}

fn beyond<'j>(joint: &'j Joint, at: &Position) -> Option<&'j Value<Position>> {
    let [lower, upper] = joint.position.as_ref()?;
    if compare(at, &lower.value).is_lt() {
        return Some(lower);
    }
    compare(at, &upper.value).is_gt().then_some(upper)
}

fn read(joint: &Joint, text: &str, problems: &mut Problems) -> Option<Position> {
    let Joint { name, kind, .. } = joint;
    let number = parse_decimal(text.trim());
    let read = match kind {
        Kind::Fixed | Kind::Planar | Kind::Floating | Kind::Ball => {
            return problems.refuse("has_no_position", &joint.at, &[name, &kind.word()]);
        }
        Kind::Prismatic => number.map(Position::Length),
        Kind::Revolute | Kind::Continuous => {
            let angle = number.map(Angle::Radians).or_else(|_| Angle::parse(text));
            angle.map(|angle| Position::Angle(right(angle)))
        }
    };
    match read {
        Ok(position) => Some(position),
        Err(error) => problems.refuse("lock_number", &joint.at, &[name, &text, &error]),
    }
}

/// Returns the position that a text gives. One outside the limits is an error, as in a scene of a
/// robot file: the arm cannot be there, and most often degrees were given for radians.
pub(crate) fn within(joint: &Joint, text: &str, problems: &mut Problems) -> Option<Position> {
    let Joint { name, kind, .. } = joint;
    let at = read(joint, text, problems)?;
    if let Some([lower, upper]) = &joint.position
        && is_outside(&at, text, [lower, upper])
    {
        let degrees = match (&at, kind) {
            (Position::Angle(Angle::Radians(_)), Kind::Revolute) => {
                "; a number is in rad, degrees are written as 90deg"
            }
            _ => "",
        };
        let words: [&dyn Display; 5] = [name, &text, &lower.text, &upper.text, &degrees];
        return problems.refuse("lock_outside", &lower.at, &words);
    }
    Some(at)
}

/// Returns a position to lock a joint at, as an option takes it.
pub(crate) fn advised(joint: &Joint) -> &str {
    let zero = joint.kind.position(Default::default());
    beyond(joint, &zero).map_or("0", |limit| limit.text.as_str())
}

/// True if a position is outside of limits. All three are taken as they were meant: 1.5708 is
/// within a limit of pi/2.
fn is_outside(at: &Position, text: &str, [lower, upper]: [&Value<Position>; 2]) -> bool {
    let as_meant = |value: &Position, text: &str| match value {
        Position::Angle(angle) => Position::Angle(meant(angle, text).unwrap_or(angle.clone())),
        length => length.clone(),
    };
    let at = as_meant(at, text.trim());
    let [lower, upper] = [lower, upper].map(|limit| as_meant(&limit.value, &limit.text));
    compare(&at, &lower).is_lt() || compare(&at, &upper).is_gt()
}

/// Compares positions of one joint; an angle and a length have no order.
pub(crate) fn compare(left: &Position, right: &Position) -> Ordering {
    match (left, right) {
        (Position::Angle(left), Position::Angle(right)) => left.cmp_value(right),
        (Position::Length(left), Position::Length(right)) => left.cmp(right),
        _ => Ordering::Equal,
    }
}

/// Returns an angle, exactly if it is the double next to a multiple of π/2, as other tools print
/// that.
pub(crate) fn right(angle: Angle) -> Angle {
    let Angle::Radians(value) = angle else {
        return angle;
    };
    SnappedAngle::of_radians(value).angle()
}
