//! Twists and wrenches, and the power of the one on the other.

use super::matrix::{Vector, cross, dot, plus, scaled, sum, twice, zero_vector};
use crate::robot::JointKind;
use crate::scalar::Scalar;

/// A velocity, acceleration or virtual displacement of a frame.
#[derive(Clone, Debug)]
pub(super) struct Twist<S> {
    pub(super) turn: Vector<S>,
    /// The linear part, of the frame's origin.
    pub(super) shift: Vector<S>,
}

/// A force and a moment.
#[derive(Clone, Debug)]
pub struct Wrench<S> {
    /// N
    pub force: Vector<S>,
    /// N·m
    pub moment: Vector<S>,
}

impl<S: Scalar> Twist<S> {
    pub(super) fn rest() -> Self {
        Twist {
            turn: zero_vector(),
            shift: zero_vector(),
        }
    }

    pub(super) fn of_joint(kind: JointKind, axis: Vector<S>) -> Self {
        let rest = Twist::rest();
        match kind {
            JointKind::Revolute => Twist { turn: axis, ..rest },
            JointKind::Prismatic => Twist {
                shift: axis,
                ..rest
            },
        }
    }

    pub(super) fn with(&self, other: &Self) -> Self {
        Twist {
            turn: sum(&self.turn, &other.turn),
            shift: sum(&self.shift, &other.shift),
        }
    }

    pub(super) fn doubled(&self) -> Self {
        Twist {
            turn: self.turn.each_ref().map(twice),
            shift: self.shift.each_ref().map(twice),
        }
    }

    pub(super) fn cross(&self, other: &Self) -> Self {
        Twist {
            turn: cross(&self.turn, &other.turn),
            shift: sum(
                &cross(&self.turn, &other.shift),
                &cross(&self.shift, &other.turn),
            ),
        }
    }
}

impl<S: Scalar> Wrench<S> {
    pub(super) fn zero() -> Self {
        Wrench::couple(zero_vector())
    }

    pub(super) fn couple(moment: Vector<S>) -> Self {
        Wrench {
            force: zero_vector(),
            moment,
        }
    }

    pub(super) fn part(&self, kind: JointKind) -> &Vector<S> {
        match kind {
            JointKind::Revolute => &self.moment,
            JointKind::Prismatic => &self.force,
        }
    }

    /// Returns its power on a twist about the same point.
    pub(super) fn along(&self, twist: &Twist<S>) -> S {
        plus(
            &dot(&twist.turn, &self.moment),
            &dot(&twist.shift, &self.force),
        )
    }

    /// Returns its rate as it moves along with a twist about the same point.
    pub(super) fn turned(&self, twist: &Twist<S>) -> Self {
        Wrench {
            force: cross(&twist.turn, &self.force),
            moment: sum(
                &cross(&twist.turn, &self.moment),
                &cross(&twist.shift, &self.force),
            ),
        }
    }

    pub(super) fn with(&self, other: &Self) -> Self {
        Wrench {
            force: sum(&self.force, &other.force),
            moment: sum(&self.moment, &other.moment),
        }
    }

    pub(super) fn scaled(&self, factor: &S) -> Self {
        Wrench {
            force: scaled(factor, &self.force),
            moment: scaled(factor, &self.moment),
        }
    }

    pub(super) fn in_axes(&self, turn: impl Fn(&Vector<S>) -> Vector<S>) -> Self {
        Wrench {
            force: turn(&self.force),
            moment: turn(&self.moment),
        }
    }

    /// Returns it in the axes that vectors turn into like this, about an origin from which its
    /// own is a lever away.
    pub(super) fn carried(
        &self,
        turn: impl Fn(&Vector<S>) -> Vector<S>,
        lever: &Vector<S>,
    ) -> Self {
        let force = turn(&self.force);
        Wrench {
            moment: sum(&turn(&self.moment), &cross(lever, &force)),
            force,
        }
    }
}
