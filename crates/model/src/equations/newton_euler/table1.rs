//! Table 1: every vector in base axes.

use alloc::vec::Vec;

use super::{FrameMotion, with_drive};
use crate::equations::matrix::*;
use crate::equations::screws::Wrench;
use crate::equations::{Arm, At, Link};
use crate::robot::{Convention, JointKind};
use crate::scalar::Scalar;

/// One link in base axes.
struct BaseLink<S> {
    /// ⁰R_i
    rotation: [Vector<S>; 3],
    /// The joint's axis: z_{i−1}, or z_i in modified DH.
    axis: Vector<S>,
    /// p_i* = p_i − p_{i−1}
    lever: Vector<S>,
    /// s̄_i
    com: Vector<S>,
    motion: FrameMotion<S>,
}

/// Returns τ by the recursion of Table 1.
pub fn inverse_dynamics<S: Scalar>(arm: &Arm<S>, at: &At<S>, qd: &[S], qdd: &[S]) -> Vec<S> {
    let bodies = bodies(arm, at, [qd, qdd], &FrameMotion::of_base(&arm.gravity));
    let wrenches = wrenches_on(arm, &bodies);
    let torque = |(i, link): (usize, &Link<S>)| {
        let along = dot(wrenches[i].part(link.kind), &bodies[i].axis);
        with_drive(link, &along, &qd[i], &qdd[i])
    };
    arm.links.iter().enumerate().map(torque).collect()
}

/// Returns f_i and n_i: what link i−1 exerts on link i, gravity included, the moment
/// about the origin of frame i−1, or of frame i in modified DH.
pub fn wrenches<S: Scalar>(arm: &Arm<S>, at: &At<S>, qd: &[S], qdd: &[S]) -> Vec<Wrench<S>> {
    let bodies = bodies(arm, at, [qd, qdd], &FrameMotion::of_base(&arm.gravity));
    wrenches_on(arm, &bodies)
}

/// Returns v̇ and ω̇ of the hand, in the axes of frame 0, of which this is the motion.
pub(in crate::equations) fn tip_acceleration<S: Scalar>(
    arm: &Arm<S>,
    at: &At<S>,
    rates: [&[S]; 2],
    base: &FrameMotion<S>,
) -> [Vector<S>; 2] {
    let Some(last) = bodies(arm, at, rates, base).pop() else {
        return [base.acceleration.clone(), base.omega_dot.clone()];
    };
    let acceleration = last.acceleration_of(arm.tool.as_ref());
    [acceleration, last.motion.omega_dot]
}

fn wrenches_on<S: Scalar>(arm: &Arm<S>, bodies: &[BaseLink<S>]) -> Vec<Wrench<S>> {
    arm.inward(|i, arrived: Vec<(usize, Wrench<S>)>| {
        let (body, link) = (&bodies[i], &arm.links[i]);
        let inertial_force = scaled(&link.mass, &body.motion.acceleration_at(&body.com));
        let inertial_moment = body.euler(link);

        // The lever of f_{i+1}, and that of F_i, from the point the moment is taken about.
        let centre = match arm.convention {
            Convention::Standard => sum(&body.lever, &body.com),
            Convention::Modified => body.com.clone(),
        };
        let mut carried = Wrench::zero();
        for (next, wrench) in &arrived {
            let lever = match arm.convention {
                Convention::Standard => &body.lever,
                Convention::Modified => &bodies[*next].lever,
            };
            let moment = sum(&wrench.moment, &cross(lever, &wrench.force));
            let force = wrench.force.clone();
            carried = carried.with(&Wrench { force, moment });
        }
        let moment = sum(&carried.moment, &cross(&centre, &inertial_force));
        let moment = sum(&moment, &inertial_moment);
        let force = sum(&inertial_force, &carried.force);
        let wrench = Wrench { force, moment };
        (wrench.clone(), wrench)
    })
}

fn bodies<S: Scalar>(
    arm: &Arm<S>,
    at: &At<S>,
    rates: [&[S]; 2],
    base: &FrameMotion<S>,
) -> Vec<BaseLink<S>> {
    let [qd, qdd] = rates;
    let base = BaseLink {
        rotation: identity(),
        axis: zero_vector(),
        lever: zero_vector(),
        com: zero_vector(),
        motion: base.clone(),
    };
    arm.outward(&base, |i, before: &BaseLink<S>| {
        let (step, link) = (arm.step(i, at), &arm.links[i]);
        // The step's own origin is p_i*: no difference of two large positions.
        let frame = step.append(&Columns::turned(before.rotation.clone()));
        let body = BaseLink {
            com: frame.rotate(&link.com),
            axis: step.at_joint(&before.rotation, &frame.axes)[2].clone(),
            rotation: frame.axes,
            lever: frame.origin,
            motion: before.motion.clone(),
        };
        body.moved(arm.convention, link.kind, &qd[i], &qdd[i])
    })
}

impl<S: Scalar> BaseLink<S> {
    fn acceleration_of(&self, tool: Option<&Columns<S>>) -> Vector<S> {
        let Some(tool) = tool else {
            return self.motion.acceleration.clone();
        };
        let axes = Columns::turned(self.rotation.clone());
        self.motion.acceleration_at(&axes.rotate(&tool.origin))
    }

    fn moved(mut self, convention: Convention, kind: JointKind, qd: &S, qdd: &S) -> Self {
        let before = self.motion.clone();
        let motion = &mut self.motion;
        let rate = scaled(qd, &self.axis);
        if kind == JointKind::Revolute {
            motion.omega = sum(&before.omega, &rate);
            let turning = sum(&scaled(qdd, &self.axis), &cross(&before.omega, &rate));
            motion.omega_dot = sum(&before.omega_dot, &turning);
        }
        // The lever p_i* belongs to link i, or to link i−1 in modified DH.
        let turns = match convention {
            Convention::Standard => &*motion,
            Convention::Modified => &before,
        };
        motion.acceleration = sum(&before.acceleration, &turns.of_lever(&self.lever));
        if kind == JointKind::Prismatic {
            let coriolis = cross(&motion.omega, &scaled(&twice(qd), &self.axis));
            let sliding = sum(&scaled(qdd, &self.axis), &coriolis);
            motion.acceleration = sum(&motion.acceleration, &sliding);
        }
        self
    }

    /// Returns N_i = I ω̇_i + ω_i × (I ω_i) with I = ⁰R_i I_i ⁱR_0.
    fn euler(&self, link: &Link<S>) -> Vector<S> {
        let frame = Columns::turned(self.rotation.clone());
        let tensor =
            |v: &Vector<S>| frame.rotate(&tensor_times(&link.inertia, &frame.rotate_back(v)));
        let spin = cross(&self.motion.omega, &tensor(&self.motion.omega));
        sum(&tensor(&self.motion.omega_dot), &spin)
    }
}
