//! From one frame to the next, through a joint.

use super::body::Articulated;
use crate::equations::matrix::{Columns, Vector, cross, sum};
use crate::equations::screws::{Twist, Wrench};
use crate::equations::{Arm, DhVariables, Link};
use crate::robot::Convention;
use crate::scalar::Divide;

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

    /// A joint moves about or along z of its frame, which is i−1 in standard DH and i in modified.
    pub(super) fn along(&self, rate: &S) -> Twist<S> {
        Twist::of_joint(self.link.kind, [S::zero(), S::zero(), rate.clone()])
    }

    pub(super) fn depends_on<'w>(&self, wrench: &'w Wrench<S>) -> &'w S {
        &wrench.part(self.link.kind)[2]
    }

    pub(super) fn outward<T>(
        &self,
        before: &Twist<S>,
        joint: impl FnOnce(Twist<S>) -> (Twist<S>, T),
    ) -> (Twist<S>, T) {
        match self.arm.convention {
            Convention::Standard => {
                let (moved, other) = joint(before.clone());
                (self.seen(&moved), other)
            }
            Convention::Modified => joint(self.seen(before)),
        }
    }

    fn seen(&self, motion: &Twist<S>) -> Twist<S> {
        let shift = sum(&motion.shift, &cross(&motion.turn, &self.lever));
        let turned = |v: &Vector<S>| self.link.to_link(self.arm.convention, self.at, v);
        Twist {
            turn: turned(&motion.turn),
            shift: turned(&shift),
        }
    }

    /// Carries it from frame i to frame i−1, in this convention alone: the joint's frame is the
    /// latter in standard DH, and the former in modified.
    pub(super) fn back_in(
        &self,
        convention: Convention,
        body: Articulated<S>,
        bias: Wrench<S>,
    ) -> (Articulated<S>, Wrench<S>) {
        if self.arm.convention != convention {
            return (body, bias);
        }
        let turned = |v: &Vector<S>| self.link.to_previous(convention, self.at, v);
        let bias = bias.carried(turned, &self.lever);
        (body.carried(turned, &self.lever), bias)
    }
}
