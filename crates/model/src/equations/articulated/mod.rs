//! Forward dynamics by articulated bodies: Featherstone, *Rigid Body Dynamics
//! Algorithms* (2008), section 7.3, in the axes of each link's own frame, both
//! DH conventions, rotors' inertia and friction included.
//!
//! The articulated body i is link i with all that follows it, each joint free to move under its own
//! torque. What it answers to an acceleration a of its frame is I a + p; the joint before gives way
//! along its axis, and takes the part d = Sᵀ I S + armature along it out of I. Nothing is assembled
//! or factorised: D does not occur.
//!
//! - `body`: what a body answers to motions
//! - `step`: from one frame to the next, through a joint

mod body;
mod step;

use alloc::vec::Vec;

use super::matrix::{minus, opposite, over, plus, times, zero_vector};
use super::screws::{Twist, Wrench};
use super::{Arm, DhVariables};
use crate::robot::Convention;
use crate::scalar::Divide;
use body::{Articulated, power};
use step::Step;

struct Joint<S> {
    /// I S: what an acceleration along the joint takes.
    push: Wrench<S>,
    rest: S,
    /// 1/d; zero of a joint that is held.
    inverse: S,
    drift: Twist<S>,
}

/// Returns q̈ of the joints that move, zero of the others, which are held where they are.
pub fn forward_dynamics<S: Divide>(
    arm: &Arm<S>,
    at: &[DhVariables<S>],
    qd: &[S],
    tau: &[S],
    moves: &[bool],
) -> Vec<S> {
    let n = arm.links.len();
    let steps: Vec<Step<'_, S>> = (0..n).map(|i| Step::new(arm, i, at)).collect();
    let mut velocities: Vec<Twist<S>> = Vec::with_capacity(n);
    let mut drifts = Vec::with_capacity(n);
    let rest = Twist::rest();
    for (i, step) in steps.iter().enumerate() {
        let before = velocities.last().unwrap_or(&rest);
        let own = step.along(&qd[i]);
        let (velocity, drift) = step.outward(before, |frame| (frame.with(&own), frame.cross(&own)));
        velocities.push(velocity);
        drifts.push(drift);
    }
    let mut joints: Vec<Joint<S>> = Vec::with_capacity(n);
    let mut body = Articulated::zero();
    let mut bias = Wrench::zero();
    for (i, drift) in drifts.into_iter().enumerate().rev() {
        let (step, link) = (&steps[i], &arm.links[i]);
        let (own, own_bias) = Articulated::of(link, &velocities[i]);
        let (whole, whole_bias) = (body.plus(&own), bias.with(&own_bias));
        let (whole, whole_bias) = step.back_in(Convention::Standard, whole, whole_bias);
        let push = whole.times(&step.along(&S::one()));
        let pivot = plus(step.depends_on(&push), &link.armature);
        let damped = minus(&tau[i], &link.friction.torque(&qd[i]));
        let left = minus(&damped, step.depends_on(&whole_bias));
        let inverse = match moves[i] {
            true => over(&S::one(), &pivot),
            false => S::zero(),
        };
        let given = whole.without(&push, &inverse);
        let moved = whole_bias.with(&given.times(&drift));
        let given_bias = moved.with(&push.scaled(&times(&left, &inverse)));
        (body, bias) = step.back_in(Convention::Modified, given, given_bias);
        joints.push(Joint {
            push,
            rest: left,
            inverse,
            drift,
        });
    }
    joints.reverse();
    // Accelerations, outward: the base rises instead of being pulled down.
    let mut before = Twist {
        turn: zero_vector(),
        shift: opposite(&arm.gravity),
    };
    let mut accelerations = Vec::with_capacity(n);
    for (step, joint) in steps.iter().zip(&joints) {
        let (next, acceleration) = step.outward(&before, |frame| {
            let frame = frame.with(&joint.drift);
            let left = minus(&joint.rest, &power(&joint.push, &frame));
            let acceleration = times(&left, &joint.inverse);
            (frame.with(&step.along(&acceleration)), acceleration)
        });
        accelerations.push(acceleration);
        before = next;
    }
    accelerations
}
