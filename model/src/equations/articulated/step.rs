//! From one frame to the next, through a joint.

use super::body::{Articulated, Motion};
use crate::equations::matrix::{Columns, Vector, cross, sum, zero_vector};
use crate::equations::newton_euler::Wrench;
use crate::equations::{Arm, DhVariables, Link};
use crate::robot::{Convention, JointKind};
use crate::scalar::Divide;

/// From frame i−1 to frame i: where the joint is, and the constant way.
pub(super) struct Step<'a, S> {
    arm: &'a Arm<S>,
    link: &'a Link<S>,
    at: &'a DhVariables<S>,
    /// The origin of frame i in frame i−1.
    lever: Vector<S>,
}

impl<'a, S: Divide> Step<'a, S> {
    pub(super) fn new(arm: &'a Arm<S>, i: usize, at: &'a [DhVariables<S>]) -> Self {
        let (link, at) = (&arm.links[i], &at[i]);
        let step = link.append(arm.convention, at, &Columns::identity());
        Step {
            arm,
            link,
            at,
            lever: step.origin,
        }
    }

    /// Returns z at a rate: both conventions move about or along the z axis of the
    /// joint's frame, which is i−1 in standard DH and i in modified.
    pub(super) fn along(&self, rate: &S) -> Motion<S> {
        let axis = [S::zero(), S::zero(), rate.clone()];
        match self.link.kind {
            JointKind::Revolute => Motion {
                turn: axis,
                shift: zero_vector(),
            },
            JointKind::Prismatic => Motion {
                turn: zero_vector(),
                shift: axis,
            },
        }
    }

    /// Returns the part of a wrench in the joint's frame that the joint feels.
    pub(super) fn depends_on(&self, wrench: &Wrench<S>) -> S {
        match self.link.kind {
            JointKind::Revolute => wrench.moment[2].clone(),
            JointKind::Prismatic => wrench.force[2].clone(),
        }
    }

    /// Returns a motion of frame i−1 through the joint, then seen from frame i.
    pub(super) fn outward<T>(
        &self,
        before: &Motion<S>,
        joint: impl FnOnce(Motion<S>) -> (Motion<S>, T),
    ) -> (Motion<S>, T) {
        match self.arm.convention {
            Convention::Standard => {
                let (moved, other) = joint(before.clone());
                (self.seen(&moved), other)
            }
            Convention::Modified => joint(self.seen(before)),
        }
    }

    /// Returns a motion from frame i−1 to frame i.
    fn seen(&self, motion: &Motion<S>) -> Motion<S> {
        let shift = sum(&motion.shift, &cross(&motion.turn, &self.lever));
        let turned = |v: &Vector<S>| self.link.to_link(self.arm.convention, self.at, v);
        Motion {
            turn: turned(&motion.turn),
            shift: turned(&shift),
        }
    }

    /// Carries it from frame i to the joint's frame.
    pub(super) fn at_joint(
        &self,
        body: Articulated<S>,
        bias: Wrench<S>,
    ) -> (Articulated<S>, Wrench<S>) {
        match self.arm.convention {
            Convention::Standard => self.back(&body, &bias),
            Convention::Modified => (body, bias),
        }
    }

    /// Carries it from the joint's frame to frame i−1.
    pub(super) fn before_joint(
        &self,
        body: Articulated<S>,
        bias: Wrench<S>,
    ) -> (Articulated<S>, Wrench<S>) {
        match self.arm.convention {
            Convention::Standard => (body, bias),
            Convention::Modified => self.back(&body, &bias),
        }
    }

    /// Carries it from frame i to frame i−1.
    fn back(&self, body: &Articulated<S>, bias: &Wrench<S>) -> (Articulated<S>, Wrench<S>) {
        let turned = |v: &Vector<S>| self.link.to_previous(self.arm.convention, self.at, v);
        let force = turned(&bias.force);
        let moment = sum(&turned(&bias.moment), &cross(&self.lever, &force));
        (body.carried(turned, &self.lever), Wrench { force, moment })
    }
}
