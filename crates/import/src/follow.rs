//! Joints that follow others (`mimic`): their tables in the robot file, and limits that would hold
//! the joints that they follow.

use std::collections::{BTreeMap, BTreeSet};

use dalembert_model::number::{Angle, Rational};
use dalembert_model::robot::values::{number, position, table};
use dalembert_model::robot::{self, Follower, Limits, Position};

use crate::model::{Joint, Kind};
use crate::problems::Problems;
use crate::select::position::right;

/// Returns the leader of a joint, and the multiplier and the offset by which the joint follows.
fn follows<'j>(joint: &'j Joint, joints: &[&Joint]) -> Option<(usize, &'j Rational, Position)> {
    let mimic = joint.mimic.as_ref()?;
    let [multiplier, offset] = mimic.line.as_ref()?;
    let mut leaders = joints.iter();
    let leader = leaders.position(|joint| joint.name == mimic.leader)?;
    let offset = match joint.kind {
        Kind::Prismatic => Position::Length(offset.clone()),
        _ => Position::Angle(right(Angle::Radians(offset.clone()).canonical())),
    };
    Some((leader, multiplier, offset))
}

pub(crate) fn mimic(follower: &Joint, joints: &[&Joint]) -> Option<String> {
    let (leader, multiplier, offset) = follows(follower, joints)?;
    table([
        ("joint", Some((leader + 1).to_string())),
        ("multiplier", Some(number(multiplier))),
        ("offset", Some(position(&offset))),
    ])
}

/// Returns the range of a joint as it is written.
pub(crate) fn range(joint: &Joint) -> Option<[Position; 2]> {
    let range = joint.position.as_ref()?;
    Some(range.each_ref().map(|end| match &end.value {
        Position::Angle(angle) => Position::Angle(right(angle.clone())),
        length => length.clone(),
    }))
}

/// Returns the names of joints whose range would let the joint that they follow not move at all.
pub(crate) fn without_room<'m>(joints: &[&'m Joint], problems: &mut Problems) -> BTreeSet<&'m str> {
    let limited = |joint: &Joint| robot::Joint {
        limits: Limits {
            position: range(joint),
            ..Limits::default()
        },
        ..robot::Joint::default()
    };
    let mut narrowed: BTreeMap<usize, robot::Joint> = BTreeMap::new();
    let mut names = BTreeSet::new();
    for (row, joint) in joints.iter().enumerate() {
        let Some((leader, multiplier, offset)) = follows(joint, joints) else {
            continue;
        };
        let follower = Follower {
            row,
            leader,
            multiplier: multiplier.clone(),
            offset,
            joint: limited(joint),
        };
        let entry = narrowed.entry(leader);
        let leading = entry.or_insert_with(|| limited(joints[leader]));
        let before = leading.clone();
        if follower.narrow(leading).is_none() {
            *leading = before;
            let position = joint.position.as_ref();
            let at = position.map_or(&joint.at, |[low, _]| &low.at);
            problems.report("no_room", at, &[&joint.name, &joints[leader].name]);
            names.insert(joint.name.as_str());
        }
    }
    names
}
