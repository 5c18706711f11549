//! Joints that follow others (`mimic`): their tables in the robot file, and limits that would hold
//! the joints that they follow.

use std::collections::{BTreeMap, BTreeSet};

use dalembert_model::number::{Angle, Rational};
use dalembert_model::robot::values::{number, position, table};
use dalembert_model::robot::{self, Follower, Limits, Position};

use crate::model::{Joint, Kind};
use crate::problems::Problems;
use crate::select::position::right;

struct Follows<'j> {
    leader: usize,
    multiplier: &'j Rational,
    offset: Position,
}

fn follows<'j>(joint: &'j Joint, joints: &[&Joint]) -> Option<Follows<'j>> {
    let mimic = joint.mimic.as_ref()?;
    let [multiplier, offset] = mimic.line.as_ref()?;
    let mut leaders = joints.iter();
    let leader = leaders.position(|joint| joint.name == mimic.leader)?;
    let offset = match joint.kind {
        Kind::Prismatic => Position::Length(offset.clone()),
        _ => Position::Angle(right(Angle::Radians(offset.clone()).canonical())),
    };
    Some(Follows {
        leader,
        multiplier,
        offset,
    })
}

pub(crate) fn mimic(follower: &Joint, joints: &[&Joint]) -> Option<String> {
    let relation = follows(follower, joints)?;
    table([
        ("joint", Some((relation.leader + 1).to_string())),
        ("multiplier", Some(number(relation.multiplier))),
        ("offset", Some(position(&relation.offset))),
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

/// Returns the names of joints whose range is left out: with it, the joint that they follow could not
/// move at all.
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
        let Some(relation) = follows(joint, joints) else {
            continue;
        };
        let follower = Follower {
            row,
            leader: relation.leader,
            multiplier: relation.multiplier.clone(),
            offset: relation.offset,
            joint: limited(joint),
        };
        let leader = narrowed
            .entry(relation.leader)
            .or_insert_with(|| limited(joints[relation.leader]));
        let before = leader.clone();
        if follower.narrow(leader).is_none() {
            *leader = before;
            let leader = joints[relation.leader].name.as_str();
            let at = joint
                .position
                .as_ref()
                .map_or(&joint.at, |[low, _]| &low.at);
            problems.say("no_room", at, &[&joint.name, &leader]);
            names.insert(joint.name.as_str());
        }
    }
    names
}
