//! Forward dynamics by articulated bodies: Featherstone, *Rigid Body Dynamics
//! Algorithms* (2008), section 7.3, in the axes of each link's own frame, both
//! DH conventions, rotors' inertia and friction included.
//!
//! The articulated body i is link i with all that follows it, each joint free to move under its own
//! torque. Its answer to an acceleration a of its frame is I a + p; the joint before gives way
//! along its axis, and takes the part d = Sᵀ I S + armature along it out of I. Nothing is assembled
//! or factorised: D does not occur.

use alloc::vec::Vec;

use super::arm::Step;
use super::matrix::*;
use super::screws::{Twist, Wrench};
use super::{Arm, At, Link};
use crate::robot::Convention;
use crate::scalar::Divide;

/// Returns q̈ of the joints that move, zero of the others, which are held where they are.
pub fn forward_dynamics<S: Divide>(
    arm: &Arm<S>,
    at: &At<S>,
    [qd, tau]: [&[S]; 2],
    moves: &[bool],
) -> Vec<S> {
    let frames: Vec<StepFrame<'_, S>> = arm.steps(at).map(StepFrame::new).collect();
    let at_rest = (Twist::rest(), Twist::rest());
    let moving = arm.outward(&at_rest, |i, (before, _)| {
        let joint_twist = frames[i].along(&qd[i]);
        let moved = |before: Twist<S>| (before.with(&joint_twist), before.cross(&joint_twist));
        frames[i].outward(before, moved)
    });
    let passes = arm.inward(|i, arrived: Vec<(usize, Biased<S>)>| {
        let (mut body, mut bias) = (ArticulatedInertia::zero(), Wrench::zero());
        for (_, (other, other_bias)) in &arrived {
            (body, bias) = (body.plus(other), bias.with(other_bias));
        }
        let (velocity, drift) = moving[i].clone();
        let (frame, link) = (&frames[i], &arm.links[i]);
        let (own_inertia, own_bias) = ArticulatedInertia::of(link, &velocity);
        let (whole, whole_bias) = (body.plus(&own_inertia), bias.with(&own_bias));
        let (whole, whole_bias) = frame.back_in(Convention::Standard, whole, whole_bias);
        // I S: what an acceleration along the joint takes.
        let push = whole.times(&frame.along(&S::one()));
        let pivot = plus(frame.depends_on(&push), &link.armature);
        let damped = minus(&tau[i], &link.friction.torque(&qd[i]));
        let rest = minus(&damped, frame.depends_on(&whole_bias));
        let inverse = match moves[i] {
            true => over(&S::one(), &pivot),
            false => S::zero(),
        };
        let apparent_inertia = whole.without(&push, &inverse);
        let moved = whole_bias.with(&apparent_inertia.times(&drift));
        let apparent_bias = moved.with(&push.scaled(&times(&rest, &inverse)));
        let sent = frame.back_in(Convention::Modified, apparent_inertia, apparent_bias);
        (sent, (push, rest, inverse, drift))
    });
    // Accelerations, outward: the base rises instead of being pulled down.
    let (turn, shift) = (zero_vector(), opposite(&arm.gravity));
    let base = Twist { turn, shift };
    let mut accelerations = Vec::with_capacity(passes.len());
    arm.outward(&base, |i, before| {
        let (frame, (push, rest, inverse, drift)) = (&frames[i], &passes[i]);
        let (next, acceleration) = frame.outward(before, |at_joint| {
            let drifting = at_joint.with(drift);
            let left = minus(rest, &power(push, &drifting));
            let acceleration = times(&left, inverse);
            (drifting.with(&frame.along(&acceleration)), acceleration)
        });
        accelerations.push(acceleration);
        next
    });
    accelerations
}

struct StepFrame<'a, S> {
    step: Step<'a, S>,
    /// Its origin in the frame before.
    lever: Vector<S>,
}

impl<'a, S: Divide> StepFrame<'a, S> {
    fn new(step: Step<'a, S>) -> Self {
        let lever = step.lever();
        StepFrame { step, lever }
    }

    /// A joint moves about or along z of its frame, which is i−1 in standard DH and i in modified.
    fn along(&self, rate: &S) -> Twist<S> {
        Twist::of_joint(self.step.link.kind, [S::zero(), S::zero(), rate.clone()])
    }

    fn depends_on<'w>(&self, wrench: &'w Wrench<S>) -> &'w S {
        &wrench.part(self.step.link.kind)[2]
    }

    fn outward<T>(
        &self,
        before: &Twist<S>,
        joint: impl FnOnce(Twist<S>) -> (Twist<S>, T),
    ) -> (Twist<S>, T) {
        match self.step.convention {
            Convention::Standard => {
                let (moved, other) = joint(before.clone());
                (self.seen(&moved), other)
            }
            Convention::Modified => joint(self.seen(before)),
        }
    }

    fn seen(&self, motion: &Twist<S>) -> Twist<S> {
        let shift = sum(&motion.shift, &cross(&motion.turn, &self.lever));
        let [turn, shift] = [&motion.turn, &shift].map(|v| self.step.to_link(v));
        Twist { turn, shift }
    }

    /// Carries it from frame i to frame i−1, in this convention alone: the joint's frame is the
    /// latter in standard DH, and the former in modified.
    fn back_in(
        &self,
        convention: Convention,
        body: ArticulatedInertia<S>,
        bias: Wrench<S>,
    ) -> (ArticulatedInertia<S>, Wrench<S>) {
        if self.step.convention != convention {
            return (body, bias);
        }
        let turned = |v: &Vector<S>| self.step.to_previous(v);
        let bias = bias.carried(turned, &self.lever);
        (body.carried(turned, &self.lever), bias)
    }
}

/// An articulated inertia and its bias p.
type Biased<S> = (ArticulatedInertia<S>, Wrench<S>);

type Block<S> = [Vector<S>; 3];

/// The articulated inertia: a moment `turn`·α + `mixed`·a, a force `mixed`ᵀ·α + `shift`·a.
struct ArticulatedInertia<S> {
    turn: Block<S>,
    mixed: Block<S>,
    shift: Block<S>,
}

impl<S: Divide> ArticulatedInertia<S> {
    fn zero() -> Self {
        let [turn, mixed, shift] = three(|_| three(|_| zero_vector()));
        ArticulatedInertia { turn, mixed, shift }
    }

    fn of(link: &Link<S>, velocity: &Twist<S>) -> (Self, Wrench<S>) {
        let (mass, com) = (&link.mass, &link.com);
        let first = scaled(mass, com);
        let about_centre: Block<S> = link.inertia.rows();
        // I + m (s̄·s̄ 1 − s̄ s̄ᵀ) = I − [m s̄]× [s̄]×
        let steiner = rows_crossed(&columns_crossed(&first, &identity()), com);
        let negated = steiner.map(|row| opposite(&row));
        let body = ArticulatedInertia {
            turn: block_sum(&about_centre, &negated),
            mixed: columns_crossed(&first, &identity()),
            shift: identity().map(|row| scaled(mass, &row)),
        };
        let Twist { turn, shift } = velocity;
        // At the centre of mass: ω × (m v_c), and about it ω × (I ω).
        let centre = sum(shift, &cross(turn, com));
        let force = cross(turn, &scaled(mass, &centre));
        let spin = cross(turn, &tensor_times(&link.inertia, turn));
        let moment = sum(&spin, &cross(com, &force));
        (body, Wrench { force, moment })
    }

    fn plus(&self, other: &Self) -> Self {
        let turn = block_sum(&self.turn, &other.turn);
        let mixed = block_sum(&self.mixed, &other.mixed);
        let shift = block_sum(&self.shift, &other.shift);
        ArticulatedInertia { turn, mixed, shift }
    }

    fn times(&self, Twist { turn, shift }: &Twist<S>) -> Wrench<S> {
        let by = |block: &Block<S>, v: &Vector<S>| block.each_ref().map(|row| dot(row, v));
        let turning = by(&transposed(&self.mixed), turn);
        let force = sum(&turning, &by(&self.shift, shift));
        let moment = sum(&by(&self.turn, turn), &by(&self.mixed, shift));
        Wrench { force, moment }
    }

    /// Returns I − w wᵀ/d
    fn without(&self, push: &Wrench<S>, inverse: &S) -> Self {
        let Wrench { force, moment } = push.scaled(inverse);
        let less = |block: &Block<S>, left: &Vector<S>, right: &Vector<S>| -> Block<S> {
            three(|i| difference(&block[i], &scaled(&left[i], right)))
        };
        let turn = less(&self.turn, &moment, &push.moment);
        let mixed = less(&self.mixed, &moment, &push.force);
        let shift = less(&self.shift, &force, &push.force);
        ArticulatedInertia { turn, mixed, shift }
    }

    /// Returns it in the axes that `turn` gives, about an origin from which its own is p away:
    /// B′ = B + [p]× M, A′ = A + [p]× Bᵀ − B′ [p]×.
    fn carried(&self, turned: impl Fn(&Vector<S>) -> Vector<S>, p: &Vector<S>) -> Self {
        let rows = |block: &Block<S>| block.each_ref().map(&turned);
        let both = |block: &Block<S>| transposed(&rows(&transposed(&rows(block))));
        let [a, b, shift] = [&self.turn, &self.mixed, &self.shift].map(both);
        let mixed = block_sum(&b, &columns_crossed(p, &shift));
        let first = columns_crossed(p, &transposed(&b));
        let second = rows_crossed(&mixed, p);
        let turn = three(|i| difference(&sum(&a[i], &first[i]), &second[i]));
        ArticulatedInertia { turn, mixed, shift }
    }
}

fn power<S: Divide>(wrench: &Wrench<S>, motion: &Twist<S>) -> S {
    let turning = dot(&wrench.moment, &motion.turn);
    plus(&turning, &dot(&wrench.force, &motion.shift))
}

fn block_sum<S: Divide>(a: &Block<S>, b: &Block<S>) -> Block<S> {
    three(|i| sum(&a[i], &b[i]))
}

fn columns_crossed<S: Divide>(p: &Vector<S>, block: &Block<S>) -> Block<S> {
    transposed(&transposed(block).map(|column| cross(p, &column)))
}

fn rows_crossed<S: Divide>(block: &Block<S>, p: &Vector<S>) -> Block<S> {
    block.each_ref().map(|row| cross(row, p))
}
