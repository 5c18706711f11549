//! The tree of rows: each says which link carries it; a serial arm has one end.

use alloc::format;
use alloc::vec::Vec;

use num_traits::{One, Zero};

use super::findings::{Findings, of_joint};
use super::{Joint, Placement, Robot};
use crate::number::Rational;

/// The link that carries another.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Parent {
    /// The base.
    Base,
    /// The link of a row that comes earlier, zero-based.
    Row(usize),
}

/// The placement of a joint's link, and the axis that it moves about or along.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Placed {
    /// The link's frame at q = 0, in that of the link before, or in the frame that the base places.
    pub placement: Placement,
    /// The direction of the joint's axis, which passes through the origin of
    /// the link's frame, in the axes of that frame. Its length does not matter.
    pub axis: [Rational; 3],
}

impl Parent {
    /// The word by which robot files name the base.
    pub const BASE: &'static str = "base";

    /// Returns the row that carries one of this parent: without, the one before; `None`: the base.
    pub fn carrier(parent: Option<Parent>, row: usize) -> Option<usize> {
        match parent {
            None => row.checked_sub(1),
            Some(Parent::Base) => None,
            Some(Parent::Row(carrier)) => Some(carrier),
        }
    }
}

impl Robot {
    /// Returns the row whose link carries that of a row, both zero-based; `None` for the base.
    pub fn carrier(&self, row: usize) -> Option<usize> {
        let rows = self.rows();
        rows.get(row).and_then(|joint| joint.carrier(row))
    }

    /// Returns the most coordinates from the world to a tip: a floating base's, and a row a link.
    pub fn depth(&self) -> usize {
        let base = self.base_coordinates();
        let mut depths: Vec<usize> = Vec::new();
        for (row, joint) in self.rows().iter().enumerate() {
            depths.push(1 + joint.carrier(row).map_or(base, |carrier| depths[carrier]));
        }
        depths.into_iter().max().unwrap_or(base)
    }

    /// Returns the joints with which limbs begin, a bit each, the lowest for joint 0. A limb is what hangs
    /// on the base by one link; limbs whose joints alternate, or follow one another's, count as one.
    pub fn limb_starts(&self) -> u64 {
        let rows = 0..self.rows().len();
        limb_starts(rows.map(|row| (self.carrier(row), self.mover_of(row))))
    }

    /// True if some link is carried by another than the one before: the links branch.
    pub fn branches(&self) -> bool {
        self.rows().iter().any(|joint| joint.parent.is_some())
    }

    /// Returns the rows whose links carry no other.
    pub fn tips(&self) -> Vec<usize> {
        let rows = self.rows();
        let carried = rows.iter().enumerate();
        let carriers: Vec<_> = carried.map(|(row, joint)| joint.carrier(row)).collect();
        let is_tip = |row: &usize| !carriers.contains(&Some(*row));
        (0..rows.len()).filter(is_tip).collect()
    }
}

/// Returns the [starts of limbs](Robot::limb_starts) from each row's carrier and moving joint.
pub(crate) fn limb_starts(rows: impl Iterator<Item = (Option<usize>, usize)>) -> u64 {
    let mut roots: Vec<usize> = Vec::new();
    // The first and the last joint of each root's limb.
    let mut spans: Vec<[usize; 2]> = Vec::new();
    for (row, (carrier, joint)) in rows.enumerate() {
        let root = carrier.map_or(row, |carrier| roots[carrier]);
        roots.push(root);
        spans.push([joint; 2]);
        let [first, last] = &mut spans[root];
        (*first, *last) = (joint.min(*first), joint.max(*last));
    }
    let joints = spans.iter().map(|[_, last]| last + 1).max().unwrap_or(0);
    let is_start = |joint: &usize| {
        let mut spans = spans.iter();
        !spans.any(|[first, last]| (first + 1..=*last).contains(joint))
    };
    let starts = (0..joints.min(Robot::MAX_JOINTS)).filter(is_start);
    starts.fold(0, |bits, joint| bits | 1 << joint)
}

impl Joint {
    pub(crate) fn carrier(&self, row: usize) -> Option<usize> {
        Parent::carrier(self.parent, row)
    }

    fn has_row(&self) -> bool {
        let lengths = [&self.a, &self.d];
        let angles = [&self.alpha, &self.beta, &self.theta];
        lengths.iter().any(|x| !x.is_zero()) || angles.iter().any(|angle| !angle.is_zero())
    }
}

impl Findings {
    /// Checks who carries whom, and that joints are placed exactly where links branch. Placements
    /// that a file has, and that rows are still to be derived from, are not looked at.
    pub(super) fn tree(&mut self, robot: &Robot) {
        let is_tree = robot.is_tree();
        for (row, joint) in robot.rows().into_iter().enumerate() {
            let parent = of_joint(row, "parent");
            match joint.parent {
                Some(Parent::Row(carrier)) if carrier >= row => {
                    let message = format!("the link that carries joint {} comes later", row + 1);
                    let help = "put each joint after the one that carries it";
                    self.error(parent, message, help);
                }
                Some(carrier) if carrier == Parent::Row(row.wrapping_sub(1)) || row == 0 => {
                    let message = "the parent is the previous link";
                    self.error(parent, message, "leave it out: it is the default");
                }
                _ => {}
            }
            let Some(placed) = &joint.place else {
                if is_tree {
                    let why = match robot.floating {
                        Some(_) => "the base floats",
                        None => "links branch",
                    };
                    let message = format!("joint {} has no placement, and {why}", row + 1);
                    let help = "give every joint a placement and an axis: rows of a table cannot \
                                say where a branch begins";
                    self.error(of_joint(row, "placement"), message, help);
                }
                continue;
            };
            self.placement(&of_joint(row, "placement"), &placed.placement);
            let square: Rational = placed.axis.iter().map(|x| x * x).sum();
            if !square.is_one() {
                let message = "an axis whose length is not exactly one";
                let help = "such as [0, 0, 1] or [0.6, 0.8, 0]";
                self.error(of_joint(row, "axis"), message, help);
            }
            if !is_tree || joint.has_row() {
                let message = "the joint has both a placement and a DH row";
                let help = "joints are placed where links branch; elsewhere they have rows";
                self.error(of_joint(row, "placement"), message, help);
            }
        }
        if !robot.branches() || robot.floating.is_some() {
            return;
        }
        let tips = robot.tips().len();
        let [_, ends @ ..] = robot.placements();
        for (key, _) in ends.iter().filter(|(_, placement)| placement.is_some()) {
            let message = format!("`{key}` of a robot whose links have {tips} ends");
            let help = "a [[frame]] with a `link` says which end";
            self.error(*key, message, help);
        }
    }
}
