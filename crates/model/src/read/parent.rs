//! `parent` of a joint: the link that carries it.

use alloc::format;
use alloc::vec::Vec;

use super::value::Context;
use super::{joint, link};
use crate::robot::{Parent, Robot};

const HELP: &str =
    "parent = 2, or the name of the joint whose link carries this one; \"base\" for the base";

/// Returns the parents that are not the link before.
pub(super) fn read(cx: &mut Context, robot: &Robot, read: &[joint::Read]) -> Vec<Option<Parent>> {
    let joints = &robot.joints;
    // A parent that is not understood is of a robot that branches: nothing else is wrong with that.
    let unknown = (read.iter().any(|read| read.placed.is_some())).then_some(Parent::Base);
    let parents = read.iter().enumerate().map(|(row, read)| {
        let value = read.parent?;
        if link::is_base(robot, value) {
            return (row > 0).then_some(Parent::Base);
        }
        let Some(parent) = link::read(cx, joints, value, HELP) else {
            return unknown.filter(|_| row > 0);
        };
        if parent >= row {
            let label = |row: usize| match joints[row].name.as_deref() {
                Some(name) => format!("joint {} ({name})", row + 1),
                None => format!("joint {}", row + 1),
            };
            let (message, help) = match parent == row {
                true => (format!("{} carries itself", label(row)), HELP.into()),
                false => (
                    format!("{}, which carries this joint, comes later", label(parent)),
                    format!(
                        "put the [[joint]] table of {} before this one",
                        label(parent)
                    ),
                ),
            };
            cx.refuse::<()>(value, message, &help);
            return unknown.filter(|_| row > 0);
        }
        (parent + 1 != row).then_some(Parent::Row(parent))
    });
    parents.collect()
}
