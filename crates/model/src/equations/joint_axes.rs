//! The hand's place and the columns of J by levers in the joints' own axes.
//!
//! A joint's column is z × r, r being the lever from its axis to the hand. With r = (x, y, z) in
//! axes X, Y, Z of which Z is the joint's, that is x·Y − y·X. Carried from the hand inward, r is
//! constant in the last link and turns by one angle a joint. Where r lies in a plane with the joint's
//! axis, as past a wrist, the column is one axis times a number.
//!
//! The axes may be those before the joint turns or those after: near the base the former have
//! entries that are zero, near the hand the lever has.

use alloc::vec::Vec;

use super::arm::Step;
use super::kinematics::{at_lever, hand_of};
use super::matrix::*;
use super::{Arm, At, DhVariables, SinCosPair};
use crate::robot::{Convention, JointKind};
use crate::scalar::Scalar;

/// Returns the axes of frames 0 … n in base axes and, for an origin, the step from the one before.
pub(super) fn frames<S: Scalar>(arm: &Arm<S>, at: &At<S>) -> Vec<Columns<S>> {
    let unmoved = |frame: &Columns<S>| Columns::turned(frame.axes.clone());
    let mut frames = alloc::vec![unmoved(&arm.frame_0())];
    for step in arm.steps(at) {
        let before = frames.last().map_or_else(Columns::identity, unmoved);
        frames.push(step.append(&before));
    }
    frames
}

/// Returns the levers to the hand: from the origin of frame 0 in its axes, and from each joint's
/// axis in the axes before the joint turns and after.
fn levers<S: Scalar>(arm: &Arm<S>, at: &At<S>) -> (Vector<S>, Vec<[Vector<S>; 2]>) {
    let tool = arm.tool.as_ref();
    let mut lever = tool.map_or_else(zero_vector, |tool| tool.origin.clone());
    let of_joints = from_hand(arm.steps(at), |step| {
        let carried = |step: &Step<S>| {
            let step_lever = step.lever();
            sum(&step.to_previous(&lever), &step_lever)
        };
        let before = carried(&step);
        let of_joint = match arm.convention {
            Convention::Standard => {
                let at = &unturned(step.at);
                [before.clone(), carried(&Step { at, ..step })]
            }
            Convention::Modified => {
                let [x, y] = step.at.theta.turn(&lever[0], &lever[1]);
                [[x, y, lever[2].clone()], lever.clone()]
            }
        };
        lever = before;
        of_joint
    });
    (lever, of_joints)
}

pub(super) fn hand<S: Scalar>(arm: &Arm<S>, at: &At<S>) -> Columns<S> {
    let frames = frames(arm, at);
    let hand = hand_of(arm, &frames);
    let lever = frames[0].rotate(&levers(arm, at).0);
    at_lever(arm, hand, lever)
}

pub(super) fn columns<S: Scalar>(arm: &Arm<S>, at: &At<S>) -> Vec<[Vector<S>; 2]> {
    let (frames, levers) = (frames(arm, at), levers(arm, at).1);
    let column = |j: usize| {
        let (link, [lever, turned]) = (&arm.links[j], &levers[j]);
        let before = match arm.convention {
            Convention::Standard => frames[j].clone(),
            Convention::Modified => arm.step(j, at).before(frames[j].clone()),
        };
        let axis = before.axes[2].clone();
        if link.kind == JointKind::Prismatic {
            return [axis, zero_vector()];
        }
        let after = before.clone().turn_z(&at[j].theta);
        let linear = match zeros(&before, lever) > zeros(&after, turned) {
            true => across(&before, lever),
            false => across(&after, turned),
        };
        [linear, axis]
    };
    (0..at.len()).map(column).collect()
}

/// One axis of each frame is carried to the base, one is seen from the frame two joints before,
/// which saves the axes of the frame between, and the third is the product of both.
pub(super) fn columns_across<S: Scalar>(arm: &Arm<S>, at: &At<S>) -> Vec<[Vector<S>; 2]> {
    let carried = |v: Vector<S>, i: usize, to: usize| {
        let inner = arm.steps(at).take(i).skip(to).rev();
        inner.fold(v, |v, step| step.to_previous(&v))
    };
    let [_, y, z] = Columns::identity().axes;
    // With a twist of a right angle one of them is the joint's axis, which the frame before has.
    let [from_before, from_base] = match arm.convention {
        Convention::Standard => [(2, z), (1, y)],
        Convention::Modified => [(1, y), (2, z)],
    };
    let mut frames = frames(arm, &at[..0]);
    for i in 1..=at.len() {
        let before = i.saturating_sub(2);
        let mut axes: [Vector<S>; 3] = three(|_| zero_vector());
        axes[from_before.0] = frames[before].rotate(&carried(from_before.1.clone(), i, before));
        axes[from_base.0] = frames[0].rotate(&carried(from_base.1.clone(), i, 0));
        axes[0] = cross(&axes[1], &axes[2]);
        frames.push(Columns::turned(axes));
    }
    let levers = levers(arm, at).1;
    let column = |j: usize| {
        let (link, [before, after]) = (&arm.links[j], &levers[j]);
        let (frame, lever) = match arm.convention {
            Convention::Standard => (&frames[j], before),
            Convention::Modified => (&frames[j + 1], after),
        };
        let axis = frame.axes[2].clone();
        if link.kind == JointKind::Prismatic {
            return [axis, zero_vector()];
        }
        if 2 * j >= arm.links.len() {
            return [across(frame, lever), axis];
        }
        let mut linear = across(&Columns::identity(), before);
        if arm.convention == Convention::Modified {
            let (step, at) = (arm.step(j, at), &unturned(&at[j]));
            linear = Step { at, ..step }.to_previous(&linear);
        }
        [frames[0].rotate(&carried(linear, j, 0)), axis]
    };
    (0..at.len()).map(column).collect()
}

fn across<S: Scalar>(frame: &Columns<S>, lever: &Vector<S>) -> Vector<S> {
    let [x, y, _] = &frame.axes;
    difference(&scaled(&lever[0], y), &scaled(&lever[1], x))
}

fn zeros<S: Scalar>(frame: &Columns<S>, lever: &Vector<S>) -> usize {
    let factors = frame.axes[..2].iter().flatten().chain(&lever[..2]);
    factors.filter(|x| x.is_zero()).count()
}

fn unturned<S: Scalar>(at: &DhVariables<S>) -> DhVariables<S> {
    let (theta, d) = (SinCosPair::straight(), at.d.clone());
    DhVariables { theta, d }
}
