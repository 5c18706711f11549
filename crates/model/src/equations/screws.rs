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
        let [turn, shift] = [zero_vector(), zero_vector()];
        Twist { turn, shift }
    }

    pub(super) fn of_joint(kind: JointKind, axis: Vector<S>) -> Self {
        let (turn, shift) = match kind {
            JointKind::Revolute => (axis, zero_vector()),
            JointKind::Prismatic => (zero_vector(), axis),
        };
        Twist { turn, shift }
    }

    pub(super) fn with(&self, other: &Self) -> Self {
        let turn = sum(&self.turn, &other.turn);
        let shift = sum(&self.shift, &other.shift);
        Twist { turn, shift }
    }

    pub(super) fn doubled(&self) -> Self {
        let [turn, shift] = [&self.turn, &self.shift].map(|v| v.each_ref().map(twice));
        Twist { turn, shift }
    }

    pub(super) fn cross(&self, other: &Self) -> Self {
        let turn = cross(&self.turn, &other.turn);
        let carried = cross(&self.turn, &other.shift);
        let shift = sum(&carried, &cross(&self.shift, &other.turn));
        Twist { turn, shift }
    }
}

impl<S: Scalar> Wrench<S> {
    pub(super) fn zero() -> Self {
        Wrench::couple(zero_vector())
    }

    pub(super) fn couple(moment: Vector<S>) -> Self {
        let force = zero_vector();
        Wrench { force, moment }
    }

    pub(super) fn part(&self, kind: JointKind) -> &Vector<S> {
        match kind {
            JointKind::Revolute => &self.moment,
            JointKind::Prismatic => &self.force,
        }
    }

    /// Returns its power on a twist about the same point.
    pub(super) fn along(&self, twist: &Twist<S>) -> S {
        let by_moment = dot(&twist.turn, &self.moment);
        plus(&by_moment, &dot(&twist.shift, &self.force))
    }

    /// Returns its rate as it moves along with a twist about the same point.
    pub(super) fn turned(&self, twist: &Twist<S>) -> Self {
        let force = cross(&twist.turn, &self.force);
        let turned = cross(&twist.turn, &self.moment);
        let moment = sum(&turned, &cross(&twist.shift, &self.force));
        Wrench { force, moment }
    }

    pub(super) fn with(&self, other: &Self) -> Self {
        let force = sum(&self.force, &other.force);
        let moment = sum(&self.moment, &other.moment);
        Wrench { force, moment }
    }

    pub(super) fn scaled(&self, factor: &S) -> Self {
        self.in_axes(|part| scaled(factor, part))
    }

    pub(super) fn in_axes(&self, turn: impl Fn(&Vector<S>) -> Vector<S>) -> Self {
        let [force, moment] = [&self.force, &self.moment].map(turn);
        Wrench { force, moment }
    }

    /// Returns it in the axes that `turn` gives, about an origin from which its own is p away.
    pub(super) fn carried(&self, turn: impl Fn(&Vector<S>) -> Vector<S>, p: &Vector<S>) -> Self {
        let force = turn(&self.force);
        let moment = sum(&turn(&self.moment), &cross(p, &force));
        Wrench { force, moment }
    }
}
