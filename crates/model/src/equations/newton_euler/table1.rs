//! Table 1: every vector in base axes.

use alloc::vec::Vec;

use super::{Motion, with_drive};
use crate::equations::matrix::{
    Columns, Vector, centripetal, cross, dot, identity, scaled, sum, tensor_times, twice,
    zero_vector,
};
use crate::equations::screws::Wrench;
use crate::equations::{Arm, DhVariables, Link};
use crate::robot::{Convention, JointKind};
use crate::scalar::Scalar;

/// One link in base axes.
struct Body<S> {
    /// ⁰R_i
    rotation: [Vector<S>; 3],
    /// The joint's axis: z_{i−1}, or z_i in modified DH.
    axis: Vector<S>,
    /// p_i* = p_i − p_{i−1}
    lever: Vector<S>,
    /// s̄_i
    com: Vector<S>,
    motion: Motion<S>,
}

/// Returns τ by the recursion of Table 1.
pub fn inverse_dynamics<S: Scalar>(
    arm: &Arm<S>,
    at: &[DhVariables<S>],
    qd: &[S],
    qdd: &[S],
) -> Vec<S> {
    let bodies = bodies(arm, at, qd, qdd, &Motion::of_base(&arm.gravity));
    let wrenches = wrenches_on(arm, &bodies);
    let joints = arm.links.iter().zip(&bodies).zip(&wrenches).enumerate();
    joints
        .map(|(i, ((link, body), wrench))| {
            let along = dot(wrench.part(link.kind), &body.axis);
            with_drive(link, &along, &qd[i], &qdd[i])
        })
        .collect()
}

/// Returns f_i and n_i: what link i−1 exerts on link i, gravity included, the moment
/// about the origin of frame i−1, or of frame i in modified DH.
pub fn wrenches<S: Scalar>(
    arm: &Arm<S>,
    at: &[DhVariables<S>],
    qd: &[S],
    qdd: &[S],
) -> Vec<Wrench<S>> {
    let bodies = bodies(arm, at, qd, qdd, &Motion::of_base(&arm.gravity));
    wrenches_on(arm, &bodies)
}

/// Returns v̇ and ω̇ of the hand, in the axes of frame 0, of which this is the motion.
pub(in crate::equations) fn tip_acceleration<S: Scalar>(
    arm: &Arm<S>,
    at: &[DhVariables<S>],
    qd: &[S],
    qdd: &[S],
    base: &Motion<S>,
) -> [Vector<S>; 2] {
    match bodies(arm, at, qd, qdd, base).pop() {
        Some(last) => [
            last.acceleration_of(arm.tool.as_ref()),
            last.motion.omega_dot,
        ],
        None => [base.acceleration.clone(), base.omega_dot.clone()],
    }
}

fn wrenches_on<S: Scalar>(arm: &Arm<S>, bodies: &[Body<S>]) -> Vec<Wrench<S>> {
    let mut wrenches = Vec::with_capacity(bodies.len());
    let mut wrench = Wrench::zero();
    for (i, (body, link)) in bodies.iter().zip(&arm.links).enumerate().rev() {
        let motion = &body.motion;
        let of_com = sum(
            &cross(&motion.omega_dot, &body.com),
            &centripetal(&motion.omega, &body.com),
        );
        let inertial_force = scaled(&link.mass, &sum(&motion.acceleration, &of_com));
        let inertial_moment = body.euler(link);

        // The lever of f_{i+1}, and that of F_i, from the point the moment is taken about.
        let [lever, centre] = match arm.convention {
            Convention::Standard => [body.lever.clone(), sum(&body.lever, &body.com)],
            Convention::Modified => {
                let next = bodies.get(i + 1).map(|next| next.lever.clone());
                [next.unwrap_or_else(zero_vector), body.com.clone()]
            }
        };
        let carried = sum(&wrench.moment, &cross(&lever, &wrench.force));
        let moment = sum(&carried, &cross(&centre, &inertial_force));
        wrench = Wrench {
            moment: sum(&moment, &inertial_moment),
            force: sum(&inertial_force, &wrench.force),
        };
        wrenches.push(wrench.clone());
    }
    wrenches.reverse();
    wrenches
}

fn bodies<S: Scalar>(
    arm: &Arm<S>,
    at: &[DhVariables<S>],
    qd: &[S],
    qdd: &[S],
    base: &Motion<S>,
) -> Vec<Body<S>> {
    let mut bodies: Vec<Body<S>> = Vec::with_capacity(arm.links.len());
    let base = Body {
        rotation: identity(),
        axis: zero_vector(),
        lever: zero_vector(),
        com: zero_vector(),
        motion: base.clone(),
    };
    for (i, link) in arm.links.iter().enumerate() {
        let before = bodies.last().unwrap_or(&base);
        // Without the origin of frame i−1 the step's own origin is p_i*: no
        // difference of two large positions.
        let from_before = Columns::turned(before.rotation.clone());
        let frame = link.append(arm.convention, &at[i], &from_before);
        let axis = match arm.convention {
            Convention::Standard => before.rotation[2].clone(),
            Convention::Modified => frame.axes[2].clone(),
        };
        let body = Body {
            com: frame.rotate(&link.com),
            rotation: frame.axes,
            lever: frame.origin,
            axis,
            motion: before.motion.clone(),
        };
        bodies.push(body.moved(arm.convention, link.kind, &qd[i], &qdd[i]));
    }
    bodies
}

impl<S: Scalar> Body<S> {
    fn acceleration_of(&self, tool: Option<&Columns<S>>) -> Vector<S> {
        let Some(tool) = tool else {
            return self.motion.acceleration.clone();
        };
        let axes = Columns::turned(self.rotation.clone());
        let lever = axes.rotate(&tool.origin);
        let turning = cross(&self.motion.omega_dot, &lever);
        let of_lever = sum(&turning, &centripetal(&self.motion.omega, &lever));
        sum(&self.motion.acceleration, &of_lever)
    }

    fn moved(mut self, convention: Convention, kind: JointKind, qd: &S, qdd: &S) -> Self {
        let before = self.motion.clone();
        let own = &mut self.motion;
        let rate = scaled(qd, &self.axis);
        if kind == JointKind::Revolute {
            own.omega = sum(&before.omega, &rate);
            let turning = sum(&scaled(qdd, &self.axis), &cross(&before.omega, &rate));
            own.omega_dot = sum(&before.omega_dot, &turning);
        }
        // The lever p_i* belongs to link i, or to link i−1 in modified DH.
        let turns = match convention {
            Convention::Standard => &*own,
            Convention::Modified => &before,
        };
        let of_lever = sum(
            &cross(&turns.omega_dot, &self.lever),
            &centripetal(&turns.omega, &self.lever),
        );
        own.acceleration = sum(&before.acceleration, &of_lever);
        if kind == JointKind::Prismatic {
            let coriolis = cross(&own.omega, &scaled(&twice(qd), &self.axis));
            let sliding = sum(&scaled(qdd, &self.axis), &coriolis);
            own.acceleration = sum(&own.acceleration, &sliding);
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
