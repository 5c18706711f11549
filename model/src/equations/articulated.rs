//! Forward dynamics by articulated bodies: Featherstone, *Rigid Body Dynamics
//! Algorithms* (2008), section 7.3, in the axes of each link's own frame, both
//! DH conventions, rotors' inertia and viscous damping included.
//!
//! The articulated body i is link i with all that follows it, each joint free
//! to move under its own torque. What it answers to an acceleration a of its
//! frame is I a + p; the joint before gives way along its axis, and takes the
//! part d = Sᵀ I S + armature along it out of I. Nothing is assembled or
//! factorised: D does not occur.

use alloc::vec::Vec;

use super::matrix::{
    Columns, Vector, cross, difference, dot, minus, opposite, over, plus, scaled, sum,
    tensor_times, times, zero_vector,
};
use super::newton_euler::Wrench;
use super::{Arm, DhVariables, Link};
use crate::robot::{Convention, Inertia, JointKind};
use crate::scalar::Divide;

/// A velocity or acceleration of a frame: angular, and of its origin.
#[derive(Clone, Debug)]
struct Motion<S> {
    turn: Vector<S>,
    shift: Vector<S>,
}

/// Rows of a 3×3 matrix.
type Block<S> = [Vector<S>; 3];

/// The articulated inertia, symmetric, in blocks: the moment is
/// `turn`·α + `mixed`·a, the force `mixed`ᵀ·α + `shift`·a.
#[derive(Clone, Debug)]
struct Articulated<S> {
    turn: Block<S>,
    mixed: Block<S>,
    shift: Block<S>,
}

/// What the way out leaves for the way back.
struct Joint<S> {
    /// I S: what an acceleration along the joint takes.
    push: Wrench<S>,
    /// What is left of the torque.
    rest: S,
    /// 1/d; zero of a joint that is held.
    inverse: S,
    /// Velocity product of the joint.
    drift: Motion<S>,
}

/// q̈ of the joints that move, zero of the others, which are held where they
/// are.
pub fn forward_dynamics<S: Divide>(
    arm: &Arm<S>,
    at: &[DhVariables<S>],
    qd: &[S],
    tau: &[S],
    moves: &[bool],
) -> Vec<S> {
    let n = arm.links.len();
    let steps: Vec<Step<'_, S>> = (0..n).map(|i| Step::new(arm, i, at)).collect();
    // Velocities, outward.
    let mut velocities: Vec<Motion<S>> = Vec::with_capacity(n);
    let mut drifts = Vec::with_capacity(n);
    let rest = Motion::rest();
    for (i, step) in steps.iter().enumerate() {
        let before = velocities.last().unwrap_or(&rest);
        let own = step.along(&qd[i]);
        let (velocity, drift) = step.outward(before, |frame| (frame.plus(&own), frame.cross(&own)));
        velocities.push(velocity);
        drifts.push(drift);
    }
    // Articulated bodies, inward.
    let mut joints: Vec<Joint<S>> = Vec::with_capacity(n);
    let mut body = Articulated::zero();
    let mut bias = no_wrench();
    for (i, drift) in drifts.into_iter().enumerate().rev() {
        let (step, link) = (&steps[i], &arm.links[i]);
        let (own, own_bias) = Articulated::of(link, &velocities[i]);
        let (whole, whole_bias) = (body.plus(&own), add(&bias, &own_bias));
        let (whole, whole_bias) = step.at_joint(whole, whole_bias);
        let push = whole.times(&step.along(&S::one()));
        let pivot = plus(&step.feels(&push), &link.armature);
        let damped = minus(&tau[i], &times(&link.viscous, &qd[i]));
        let left = minus(&damped, &step.feels(&whole_bias));
        let inverse = match moves[i] {
            true => over(&S::one(), &pivot),
            false => S::zero(),
        };
        let given = whole.without(&push, &inverse);
        let moved = add(&whole_bias, &given.times(&drift));
        let given_bias = add(&moved, &by(&times(&left, &inverse), &push));
        (body, bias) = step.before_joint(given, given_bias);
        joints.push(Joint {
            push,
            rest: left,
            inverse,
            drift,
        });
    }
    joints.reverse();
    // Accelerations, outward: the base rises instead of being pulled down.
    let mut before = Motion {
        turn: zero_vector(),
        shift: opposite(&arm.gravity),
    };
    let mut accelerations = Vec::with_capacity(n);
    for (step, joint) in steps.iter().zip(&joints) {
        let (next, acceleration) = step.outward(&before, |frame| {
            let frame = frame.plus(&joint.drift);
            let left = minus(&joint.rest, &power(&joint.push, &frame));
            let acceleration = times(&left, &joint.inverse);
            (frame.plus(&step.along(&acceleration)), acceleration)
        });
        accelerations.push(acceleration);
        before = next;
    }
    accelerations
}

/// From frame i−1 to frame i: where the joint is, and the constant way.
struct Step<'a, S> {
    arm: &'a Arm<S>,
    link: &'a Link<S>,
    at: &'a DhVariables<S>,
    /// The origin of frame i in frame i−1.
    lever: Vector<S>,
}

impl<'a, S: Divide> Step<'a, S> {
    fn new(arm: &'a Arm<S>, i: usize, at: &'a [DhVariables<S>]) -> Self {
        let (link, at) = (&arm.links[i], &at[i]);
        let step = link.append(arm.convention, at, &Columns::identity());
        Step {
            arm,
            link,
            at,
            lever: step.origin,
        }
    }

    /// z at a rate: both conventions move about or along the z axis of the
    /// joint's frame, which is i−1 in standard DH and i in modified.
    fn along(&self, rate: &S) -> Motion<S> {
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

    /// The part of a wrench in the joint's frame that the joint feels.
    fn feels(&self, wrench: &Wrench<S>) -> S {
        match self.link.kind {
            JointKind::Revolute => wrench.moment[2].clone(),
            JointKind::Prismatic => wrench.force[2].clone(),
        }
    }

    /// A motion of frame i−1 through the joint, then seen from frame i.
    fn outward<T>(
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

    /// A motion from frame i−1 to frame i.
    fn seen(&self, motion: &Motion<S>) -> Motion<S> {
        let shift = sum(&motion.shift, &cross(&motion.turn, &self.lever));
        let turned = |v: &Vector<S>| self.link.to_link(self.arm.convention, self.at, v);
        Motion {
            turn: turned(&motion.turn),
            shift: turned(&shift),
        }
    }

    /// From frame i to the joint's frame.
    fn at_joint(&self, body: Articulated<S>, bias: Wrench<S>) -> (Articulated<S>, Wrench<S>) {
        match self.arm.convention {
            Convention::Standard => self.back(&body, &bias),
            Convention::Modified => (body, bias),
        }
    }

    /// From the joint's frame to frame i−1.
    fn before_joint(&self, body: Articulated<S>, bias: Wrench<S>) -> (Articulated<S>, Wrench<S>) {
        match self.arm.convention {
            Convention::Standard => (body, bias),
            Convention::Modified => self.back(&body, &bias),
        }
    }

    /// From frame i to frame i−1.
    fn back(&self, body: &Articulated<S>, bias: &Wrench<S>) -> (Articulated<S>, Wrench<S>) {
        let turned = |v: &Vector<S>| self.link.to_previous(self.arm.convention, self.at, v);
        let force = turned(&bias.force);
        let moment = sum(&turned(&bias.moment), &cross(&self.lever, &force));
        let both = |block: &Block<S>| {
            transposed(&transposed(&block.each_ref().map(turned)).map(|r| turned(&r)))
        };
        let [turn, mixed, shift] = [&body.turn, &body.mixed, &body.shift].map(both);
        // With p the lever: B′ = B + [p]× M, A′ = A + [p]× Bᵀ − B′ [p]×.
        let lever = &self.lever;
        let raised = columns_crossed(lever, &shift);
        let mixed_there = block_sum(&mixed, &raised);
        let first = columns_crossed(lever, &transposed(&mixed));
        let second = rows_crossed(&mixed_there, lever);
        let body = Articulated {
            turn: core::array::from_fn(|i| difference(&sum(&turn[i], &first[i]), &second[i])),
            mixed: mixed_there,
            shift,
        };
        (body, Wrench { force, moment })
    }
}

impl<S: Divide> Motion<S> {
    fn rest() -> Self {
        Motion {
            turn: zero_vector(),
            shift: zero_vector(),
        }
    }

    fn plus(&self, other: &Self) -> Self {
        Motion {
            turn: sum(&self.turn, &other.turn),
            shift: sum(&self.shift, &other.shift),
        }
    }

    /// The spatial cross product of motions.
    fn cross(&self, other: &Self) -> Self {
        Motion {
            turn: cross(&self.turn, &other.turn),
            shift: sum(
                &cross(&self.turn, &other.shift),
                &cross(&self.shift, &other.turn),
            ),
        }
    }
}

impl<S: Divide> Articulated<S> {
    fn zero() -> Self {
        let zero = || [zero_vector(), zero_vector(), zero_vector()];
        Articulated {
            turn: zero(),
            mixed: zero(),
            shift: zero(),
        }
    }

    /// A rigid link about its frame's origin, and V × (I V) at its velocity.
    fn of(link: &Link<S>, velocity: &Motion<S>) -> (Self, Wrench<S>) {
        let (mass, com) = (&link.mass, &link.com);
        let first = scaled(mass, com);
        let Inertia {
            xx,
            yy,
            zz,
            xy,
            yz,
            xz,
        } = &link.inertia;
        let about_centre: Block<S> =
            [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]].map(|row| row.map(S::clone));
        // I + m (s̄·s̄ 1 − s̄ s̄ᵀ) = I − [m s̄]× [s̄]×
        let steiner = rows_crossed(&columns_crossed(&first, &unit()), com);
        let negated = steiner.map(|row| opposite(&row));
        let body = Articulated {
            turn: block_sum(&about_centre, &negated),
            mixed: columns_crossed(&first, &unit()),
            shift: unit().map(|row| scaled(mass, &row)),
        };
        let Motion { turn, shift } = velocity;
        // At the centre of mass: ω × (m v_c), and about it ω × (I ω).
        let centre = sum(shift, &cross(turn, com));
        let force = cross(turn, &scaled(mass, &centre));
        let spin = cross(turn, &tensor_times(&link.inertia, turn));
        let moment = sum(&spin, &cross(com, &force));
        (body, Wrench { force, moment })
    }

    fn plus(&self, other: &Self) -> Self {
        Articulated {
            turn: block_sum(&self.turn, &other.turn),
            mixed: block_sum(&self.mixed, &other.mixed),
            shift: block_sum(&self.shift, &other.shift),
        }
    }

    fn times(&self, motion: &Motion<S>) -> Wrench<S> {
        let by = |block: &Block<S>, v: &Vector<S>| block.each_ref().map(|row| dot(row, v));
        Wrench {
            force: sum(
                &by(&transposed(&self.mixed), &motion.turn),
                &by(&self.shift, &motion.shift),
            ),
            moment: sum(
                &by(&self.turn, &motion.turn),
                &by(&self.mixed, &motion.shift),
            ),
        }
    }

    /// I − w wᵀ/d
    fn without(&self, push: &Wrench<S>, inverse: &S) -> Self {
        let (force, moment) = (scaled(inverse, &push.force), scaled(inverse, &push.moment));
        let less = |block: &Block<S>, left: &Vector<S>, right: &Vector<S>| -> Block<S> {
            core::array::from_fn(|i| difference(&block[i], &scaled(&left[i], right)))
        };
        Articulated {
            turn: less(&self.turn, &moment, &push.moment),
            mixed: less(&self.mixed, &moment, &push.force),
            shift: less(&self.shift, &force, &push.force),
        }
    }
}

fn no_wrench<S: Divide>() -> Wrench<S> {
    Wrench {
        force: zero_vector(),
        moment: zero_vector(),
    }
}

fn add<S: Divide>(a: &Wrench<S>, b: &Wrench<S>) -> Wrench<S> {
    Wrench {
        force: sum(&a.force, &b.force),
        moment: sum(&a.moment, &b.moment),
    }
}

fn by<S: Divide>(factor: &S, wrench: &Wrench<S>) -> Wrench<S> {
    Wrench {
        force: scaled(factor, &wrench.force),
        moment: scaled(factor, &wrench.moment),
    }
}

fn power<S: Divide>(wrench: &Wrench<S>, motion: &Motion<S>) -> S {
    plus(
        &dot(&wrench.moment, &motion.turn),
        &dot(&wrench.force, &motion.shift),
    )
}

fn unit<S: Divide>() -> Block<S> {
    core::array::from_fn(|i| core::array::from_fn(|k| if i == k { S::one() } else { S::zero() }))
}

fn transposed<S: Divide>(block: &Block<S>) -> Block<S> {
    core::array::from_fn(|i| core::array::from_fn(|k| block[k][i].clone()))
}

fn block_sum<S: Divide>(a: &Block<S>, b: &Block<S>) -> Block<S> {
    core::array::from_fn(|i| sum(&a[i], &b[i]))
}

/// [p]× M: p × each column.
fn columns_crossed<S: Divide>(p: &Vector<S>, block: &Block<S>) -> Block<S> {
    transposed(&transposed(block).map(|column| cross(p, &column)))
}

/// M [p]×: each row r becomes (M [p]×) = (r × p), row by row.
fn rows_crossed<S: Divide>(block: &Block<S>, p: &Vector<S>) -> Block<S> {
    block.each_ref().map(|row| cross(row, p))
}
