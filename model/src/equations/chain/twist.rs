//! Twists of joints, and wrenches that have power on them.

use super::{ChainLink, Displacement};
use crate::equations::matrix::{Vector, cross, dot, plus, sum, twice};
use crate::equations::newton_euler::Wrench;
use crate::scalar::Scalar;

/// The unit twist of a joint seen from a later frame.
#[derive(Clone, Debug)]
pub(super) struct Twist<S> {
    /// Angular part.
    pub(super) turn: Vector<S>,
    /// Velocity of the frame's origin.
    pub(super) shift: Vector<S>,
}

impl<S: Scalar> Twist<S> {
    /// Returns it as seen from the frame after this one.
    pub(super) fn outward(&self, link: &ChainLink<S>, at: &Displacement<S>) -> Self {
        let lever = link.lever(at);
        Twist {
            turn: link.inward(at, &self.turn),
            shift: link.inward(at, &sum(&self.shift, &cross(&self.turn, &lever))),
        }
    }

    /// Returns the power of a wrench about the frame's origin.
    pub(super) fn power(&self, force: &Vector<S>, moment: &Vector<S>) -> S {
        plus(&dot(&self.turn, moment), &dot(&self.shift, force))
    }

    /// Returns twice as fast.
    pub(super) fn doubled(&self) -> Self {
        Twist {
            turn: self.turn.each_ref().map(twice),
            shift: self.shift.each_ref().map(twice),
        }
    }
}

impl<S: Scalar> Wrench<S> {
    /// Returns its power on a twist about the same point.
    pub(super) fn along(&self, twist: &Twist<S>) -> S {
        twist.power(&self.force, &self.moment)
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

    /// Returns both together.
    pub(super) fn with(&self, other: &Self) -> Self {
        Wrench {
            force: sum(&self.force, &other.force),
            moment: sum(&self.moment, &other.moment),
        }
    }
}
