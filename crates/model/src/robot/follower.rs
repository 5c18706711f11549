//! Joints that follow others along a line: rows of the table without a coordinate.

use alloc::vec::Vec;

use num_traits::{One, Signed, ToPrimitive, Zero};

use super::{Joint, JointKind, Position, Robot};
use crate::number::Angle::{PiTimes, Radians};
use crate::number::{Rational, Rounded};

/// A row of the table whose joint follows another: q = multiplier · q_leader + offset.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Follower {
    /// Its row, zero-based.
    pub row: usize,
    /// The joint that it follows, zero-based among those that move by themselves.
    pub leader: usize,
    /// Its motion for a unit of the leader's; of a joint that turns a whole number.
    pub multiplier: Rational,
    /// Its position where the leader's is zero.
    pub offset: Position,
    /// The row of the table.
    pub joint: Joint,
}

impl Follower {
    /// The largest multiplier of a joint that turns: the degree of its sine in the leader's pair.
    pub const MAX_TURNS: i32 = 16;

    /// Returns the multiplier of a joint that turns.
    pub fn turns(&self) -> i32 {
        self.multiplier.to_integer().to_i32().unwrap_or_default()
    }

    /// Narrows a leader's limits to those between which its follower stays within its
    /// own, but for that of torque; `None` if nothing is between them.
    pub fn narrow(&self, leader: &mut Joint) -> Option<()> {
        let (limits, size) = (&self.joint.limits, self.multiplier.abs());
        if let Some(range) = &limits.position {
            let mut range = range.each_ref().map(|end| self.at_leader(end));
            if self.multiplier.is_negative() {
                range.reverse();
            }
            let [low, high] = range;
            let narrowed = match leader.limits.position.take() {
                None => [low, high],
                Some([least, most]) => [
                    if least.is_below(&low) { low } else { least },
                    if high.is_below(&most) { high } else { most },
                ],
            };
            let is_empty = !narrowed[0].is_below(&narrowed[1]);
            leader.limits.position = Some(narrowed);
            if is_empty {
                return None;
            }
        }
        let rates = [
            (&limits.velocity, &mut leader.limits.velocity),
            (&limits.acceleration, &mut leader.limits.acceleration),
        ];
        for (bound, limit) in rates {
            if let Some(bound) = bound {
                let scaled_bound = bound / &size;
                let narrower = limit.take().filter(|limit| *limit <= scaled_bound);
                *limit = Some(narrower.unwrap_or(scaled_bound));
            }
        }
        Some(())
    }

    fn at_leader(&self, at: &Position) -> Position {
        let part = Rational::one() / &self.multiplier;
        let back = self.offset.scaled(&-Rational::one());
        if let Some(exact) = at.plus(&back) {
            return exact.scaled(&part);
        }
        // π is not rational.
        nearest((at.number() - self.offset.number()) * part)
    }
}

fn nearest(radians: Rational) -> Position {
    let nearest = Rational::from_float(Radians(radians.clone()).to_f64());
    Position::Angle(Radians(nearest.unwrap_or(radians)).canonical())
}

impl Position {
    /// Returns the nearest double of the number of radians or metres.
    pub fn to_f64(&self) -> f64 {
        match self {
            Position::Angle(angle) => angle.to_f64(),
            Position::Length(length) => f64::nearest_rational(length),
        }
    }

    /// Returns the position times a number.
    #[must_use]
    pub fn scaled(&self, by: &Rational) -> Position {
        match self {
            Position::Angle(PiTimes(x)) => Position::Angle(PiTimes(x * by)),
            Position::Angle(Radians(x)) => Position::Angle(Radians(x * by)),
            Position::Angle(angle) if by.is_one() => Position::Angle(angle.clone()),
            Position::Angle(angle) if (-by).is_one() => Position::Angle(angle.negate()),
            Position::Angle(angle) => nearest(angle.radians() * by),
            Position::Length(x) => Position::Length(x * by),
        }
    }

    /// Returns the sum; `None` for a multiple of π and other radians, or for an angle and a length.
    pub fn plus(&self, other: &Position) -> Option<Position> {
        use Position::{Angle as Turn, Length};
        match (self, other) {
            (Turn(angle), _) if angle.is_zero() => Some(other.clone()),
            (_, Turn(other)) if other.is_zero() => Some(self.clone()),
            (Turn(PiTimes(a)), Turn(PiTimes(b))) => Some(Turn(PiTimes(a + b).canonical())),
            (Turn(Radians(a)), Turn(Radians(b))) => Some(Turn(Radians(a + b).canonical())),
            (Length(a), Length(b)) => Some(Length(a + b)),
            _ => None,
        }
    }

    fn number(&self) -> Rational {
        match self {
            Position::Angle(angle) => angle.radians(),
            Position::Length(length) => length.clone(),
        }
    }
}

impl Robot {
    /// Returns the rows of the table from the base to the hand: the joints, followers between them.
    pub fn rows(&self) -> Vec<&Joint> {
        let mut rows: Vec<&Joint> = self.joints.iter().collect();
        for follower in &self.followers {
            rows.insert(follower.row.min(rows.len()), &follower.joint);
        }
        rows
    }

    /// True if followers are in the order of rows, each of a joint of its kind, as equations have it.
    pub(super) fn follow(&self) -> bool {
        let ascends = self.followers.windows(2).all(|two| two[0].row < two[1].row);
        let rows = self.joints.len() + self.followers.len();
        let most = Rational::from_integer(Follower::MAX_TURNS.into());
        let can = |follower: &Follower| {
            let turns = follower.joint.kind == JointKind::Revolute;
            let leader = self.joints.get(follower.leader);
            let is_whole = follower.multiplier.is_integer() && follower.multiplier.abs() <= most;
            follower.row < rows
                && leader.is_some_and(|leader| leader.kind == follower.joint.kind)
                && follower.offset.is_of(follower.joint.kind)
                && !follower.multiplier.is_zero()
                && (is_whole || !turns)
                && !follower.joint.has_coulomb()
        };
        ascends && self.followers.iter().all(can)
    }

    /// Returns a row, to be changed.
    pub fn row_mut(&mut self, row: usize) -> Option<&mut Joint> {
        let joint = self.mover_of(row);
        let mut followers = self.followers.iter_mut();
        match followers.find(|follower| follower.row == row) {
            Some(follower) => Some(&mut follower.joint),
            None => self.joints.get_mut(joint),
        }
    }

    /// Returns the row of a joint, both zero-based.
    pub fn row_of(&self, joint: usize) -> usize {
        let past = |row, follower: &Follower| row + usize::from(follower.row <= row);
        self.followers.iter().fold(joint, past)
    }

    /// Returns the joint by whose motion a row moves, both zero-based.
    pub fn mover_of(&self, row: usize) -> usize {
        match self.followers.iter().find(|follower| follower.row == row) {
            Some(follower) => follower.leader,
            None => {
                let before = self.followers.iter().filter(|follower| follower.row < row);
                row - before.count()
            }
        }
    }

    /// Takes rows, in their order, for followers. Each names its leader by a row that is none.
    pub fn with_followers(mut self, mut followers: Vec<Follower>) -> Robot {
        for follower in followers.iter_mut().rev() {
            follower.joint = self.joints.remove(follower.row);
        }
        let rows: Vec<usize> = followers.iter().map(|follower| follower.row).collect();
        for follower in &mut followers {
            let before = rows.iter().filter(|row| **row < follower.leader);
            follower.leader -= before.count();
        }
        self.followers = followers;
        self
    }
}
