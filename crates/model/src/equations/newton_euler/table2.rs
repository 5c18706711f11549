//! Table 2: each vector in the axes of its own link, where I_i and s̄_i are constant.

use alloc::vec::Vec;

use super::{FrameMotion, with_drive};
use crate::equations::arm::Step;
use crate::equations::matrix::*;
use crate::equations::screws::Wrench;
use crate::equations::{Arm, At, Link};
use crate::robot::{Convention, Inertia, JointKind};
use crate::scalar::Scalar;

/// The form of the moment of the next link's force about frame i; modified DH has only the second.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Moment {
    /// ⁱR_{i+1}[n_{i+1} + (ⁱ⁺¹R_i p_i*) × f_{i+1}]: the lever is turned into frame i+1.
    AsPrinted,
    /// ⁱR_{i+1} n_{i+1} + p_i* × (ⁱR_{i+1} f_{i+1}): fewer operations, and never less accurate.
    RotateFirst,
    /// As [`Moment::RotateFirst`], and ω × (I ω) from differences of moments of inertia: about the axis
    /// of a round link it is nothing, where the products leave I_xx/I_zz times their rounding.
    Differences,
}

impl<S: Scalar> FrameMotion<S> {
    /// Returns N_i = I_i ω̇_i + ω_i × (I_i ω_i)
    fn euler(&self, link: &Link<S>, moment: Moment) -> Vector<S> {
        let spin = match moment {
            Moment::Differences => gyroscopic(&link.inertia, &self.omega),
            _ => cross(&self.omega, &tensor_times(&link.inertia, &self.omega)),
        };
        sum(&tensor_times(&link.inertia, &self.omega_dot), &spin)
    }
}

/// Returns ω × (I ω): of x (I_zz − I_yy) yz + I_yz (y + z)(y − z) + x (I_xz y − I_xy z), and so on.
fn gyroscopic<S: Scalar>(tensor: &Inertia<S>, omega: &Vector<S>) -> Vector<S> {
    let rows = tensor.rows();
    three(|x| {
        let [y, z] = [(x + 1) % 3, (x + 2) % 3];
        let [a, b, c] = [&omega[x], &omega[y], &omega[z]];
        let diagonal = times(&minus(&rows[z][z], &rows[y][y]), &times(b, c));
        let squares = times(&rows[y][z], &times(&plus(b, c), &minus(b, c)));
        let mixed = minus(&times(&rows[x][z], b), &times(&rows[x][y], c));
        plus(&plus(&diagonal, &squares), &times(a, &mixed))
    })
}

/// Returns τ by the recursion of Table 2.
pub fn inverse_dynamics<S: Scalar>(
    arm: &Arm<S>,
    at: &At<S>,
    rates: [&[S]; 2],
    moment: Moment,
) -> Vec<S> {
    let loads = loads(arm, at, rates, moment).into_iter();
    loads.map(|(torque, _)| torque).collect()
}

/// Returns the wrench that the ground exerts on the base, in the axes of frame 0 about its origin.
pub fn wrench_on_base<S: Scalar>(
    arm: &Arm<S>,
    at: &At<S>,
    rates: [&[S]; 2],
    moment: Moment,
) -> Wrench<S> {
    let loads = loads(arm, at, rates, moment);
    let steps = arm.steps(at).zip(loads);
    steps.fold(Wrench::zero(), |total, (step, (_, on_base))| {
        let Some(wrench) = on_base else {
            return total;
        };
        let lever = match arm.convention {
            Convention::Standard => zero_vector(),
            Convention::Modified => step.lever_before(),
        };
        total.with(&wrench.carried(|v| step.to_previous(v), &lever))
    })
}

/// Returns the torque of each link, and of those that the base carries the wrench on them in their
/// axes: about the origin of frame 0 in standard DH, of their frames in modified DH.
fn loads<S: Scalar>(
    arm: &Arm<S>,
    at: &At<S>,
    [qd, qdd]: [&[S]; 2],
    moment: Moment,
) -> Vec<(S, Option<Wrench<S>>)> {
    let motions = motions(arm, at, qd, qdd);
    let steps: Vec<Step<'_, S>> = arm.steps(at).collect();
    arm.inward(|i, arrived: Vec<(usize, Wrench<S>)>| {
        let (link, motion) = (&arm.links[i], &motions[i]);
        // f_{i+1} of each link that it carries, in its axes.
        let force = |(next, wrench): &(usize, Wrench<S>)| steps[*next].to_previous(&wrench.force);
        let forces: Vec<Vector<S>> = arrived.iter().map(force).collect();
        let inertial_force = scaled(&link.mass, &motion.acceleration_at(&link.com));
        let inertial_moment = motion.euler(link, moment);

        let lever = match arm.convention {
            Convention::Standard => link.lever_here(&at[i].d),
            Convention::Modified => zero_vector(),
        };
        let moments = arrived.iter().zip(&forces).map(|((next, wrench), force)| {
            let next = &steps[*next];
            match (arm.convention, moment) {
                (Convention::Standard, Moment::AsPrinted) => {
                    let moment = cross(&next.to_link(&lever), &wrench.force);
                    next.to_previous(&sum(&wrench.moment, &moment))
                }
                (Convention::Standard, _) => {
                    sum(&next.to_previous(&wrench.moment), &cross(&lever, force))
                }
                (Convention::Modified, _) => {
                    let carried = next.to_previous(&wrench.moment);
                    sum(&carried, &cross(&next.lever_before(), force))
                }
            }
        });
        let resultant = |vectors: &mut dyn Iterator<Item = Vector<S>>| {
            vectors.fold(zero_vector(), |total, vector| sum(&total, &vector))
        };
        let carried = resultant(&mut { moments });
        let arm_of_centre = match arm.convention {
            Convention::Standard => sum(&lever, &link.com),
            Convention::Modified => link.com.clone(),
        };
        let moment = sum(&carried, &cross(&arm_of_centre, &inertial_force));
        let moment = sum(&moment, &inertial_moment);
        let force = sum(&resultant(&mut forces.into_iter()), &inertial_force);
        let wrench = Wrench { force, moment };
        let load = wrench.part(link.kind);
        let along = match arm.convention {
            Convention::Standard => dot(load, &link.axis_here()),
            Convention::Modified => load[2].clone(),
        };
        let torque = with_drive(link, &along, &qd[i], &qdd[i]);
        let on_base = arm.carrier(i).is_none().then(|| wrench.clone());
        (wrench, (torque, on_base))
    })
}

pub(in crate::equations) fn last_motion<S: Scalar>(
    arm: &Arm<S>,
    at: &At<S>,
    qd: &[S],
    qdd: &[S],
) -> FrameMotion<S> {
    let last = motions(arm, at, qd, qdd).pop();
    last.unwrap_or_else(|| FrameMotion::of_base(&arm.gravity))
}

fn motions<S: Scalar>(arm: &Arm<S>, at: &At<S>, qd: &[S], qdd: &[S]) -> Vec<FrameMotion<S>> {
    let base = FrameMotion::of_base(&arm.gravity);
    arm.outward(&base, |i, before: &FrameMotion<S>| {
        let step = arm.step(i, at);
        match step.convention {
            Convention::Standard => standard(&step, before, &qd[i], &qdd[i]),
            Convention::Modified => modified(&step, before, &qd[i], &qdd[i]),
        }
    })
}

/// The joint moves along z_{i−1}, before the rotation X, and the rows of Table 2 stand as printed.
fn standard<S: Scalar>(step: &Step<S>, before: &FrameMotion<S>, qd: &S, qdd: &S) -> FrameMotion<S> {
    let lever = step.link.lever_here(&step.at.d);
    let of_lever = |omega: &Vector<S>, omega_dot: &Vector<S>| {
        sum(&cross(omega_dot, &lever), &centripetal(omega, &lever))
    };
    match step.link.kind {
        JointKind::Revolute => {
            let omega = step.to_link(&plus_z(&before.omega, qd));
            let turning = plus_z(&cross_z(&before.omega, qd), qdd);
            let omega_dot = step.to_link(&sum(&before.omega_dot, &turning));
            let acceleration = step.to_link(&before.acceleration);
            let acceleration = sum(&acceleration, &of_lever(&omega, &omega_dot));
            FrameMotion::new(omega, omega_dot, acceleration)
        }
        JointKind::Prismatic => {
            let omega = step.to_link(&before.omega);
            let omega_dot = step.to_link(&before.omega_dot);
            let sliding = step.to_link(&plus_z(&before.acceleration, qdd));
            let along = scaled(&twice(qd), &step.link.axis_here());
            let coriolis = cross(&omega, &along);
            let acceleration = sum(&sliding, &of_lever(&omega, &omega_dot));
            FrameMotion::new(omega, omega_dot, sum(&acceleration, &coriolis))
        }
    }
}

/// The joint moves along z_i, after the rotation X, and the lever P_i belongs to the previous link.
fn modified<S: Scalar>(step: &Step<S>, before: &FrameMotion<S>, qd: &S, qdd: &S) -> FrameMotion<S> {
    let carried = step.to_link(&before.acceleration_at(&step.lever_before()));
    let omega = step.to_link(&before.omega);
    let omega_dot = step.to_link(&before.omega_dot);
    match step.link.kind {
        JointKind::Revolute => {
            let omega_dot = sum(&omega_dot, &plus_z(&cross_z(&omega, qd), qdd));
            FrameMotion::new(plus_z(&omega, qd), omega_dot, carried)
        }
        JointKind::Prismatic => {
            let sliding = plus_z(&cross_z(&omega, &twice(qd)), qdd);
            FrameMotion::new(omega, omega_dot, sum(&carried, &sliding))
        }
    }
}

fn plus_z<S: Scalar>(v: &Vector<S>, s: &S) -> Vector<S> {
    [v[0].clone(), v[1].clone(), plus(&v[2], s)]
}

impl<S: Scalar> Step<'_, S> {
    /// Returns P_i = (a_i, −d_i sin α_i, d_i cos α_i) in frame i−1 (modified DH).
    fn lever_before(&self) -> Vector<S> {
        if let Some(place) = &self.link.place {
            return sum(&place.origin, &scaled(&self.at.d, &place.axes[2]));
        }
        let alpha = &self.link.alpha;
        let sideways = negative(&times(&self.at.d, &alpha.sin));
        [self.link.a.clone(), sideways, times(&self.at.d, &alpha.cos)]
    }
}

impl<S: Scalar> Link<S> {
    /// Returns p_i* = (a_i, d_i sin α_i, d_i cos α_i) in frame i (standard DH, turned back by β).
    fn lever_here(&self, d: &S) -> Vector<S> {
        let [y, z] = [&self.alpha.sin, &self.alpha.cos].map(|part| times(d, part));
        self.tilt_back([self.a.clone(), y, z])
    }

    /// Returns X z_0 = (0, sin α_i, cos α_i), the joint's axis in frame i (standard DH).
    fn axis_here(&self) -> Vector<S> {
        self.tilt_back([S::zero(), self.alpha.sin.clone(), self.alpha.cos.clone()])
    }
}
