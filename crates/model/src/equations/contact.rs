//! Torques of a wrench that acts on the hand, and wrenches of torques.
//!
//! A wrench is the force and the moment that something else exerts on the hand, about the
//! point and in the axes of the arm's [`Axes`]: that in which J has the velocity. It does
//! the work of the torques Jᵀ w.

use alloc::vec::Vec;

use super::factor::{Factor, picked, placed, scatter};
use super::forward::{free, hold};
use super::frames::Axes;
use super::matrix::*;
use super::operational::damped;
use super::screws::Wrench;
use super::{Arm, At, Formulation};
use crate::scalar::{Divide, Scalar};

impl Formulation {
    /// Returns Jᵀ w of a wrench of six components, a torque or force a joint: the recursions in
    /// link axes carry the wrench along the chain, the others multiply by J.
    pub fn torques_of_wrench<S: Scalar>(self, arm: &Arm<S>, at: &At<S>, wrench: &[S]) -> Vec<S> {
        match self {
            Self::NewtonEulerLink | Self::NewtonEulerLinkDifferences => {
                let torques = along_links(arm, at, wrench);
                placed(zeros(at.len()), &arm.way_to_hand(), torques)
            }
            _ => products(&columns_of(&self.jacobian(arm, at)), wrench),
        }
    }

    /// Returns the wrench of the least |Jᵀ w − τ|² + λ² |w|², from torques that are its alone:
    /// (J Jᵀ + λ² 1)⁻¹ J τ of the joints that move.
    ///
    /// The pivots of J Jᵀ + λ² 1 are λ² at least; with λ² = 0 they vanish where J loses
    /// rank, and then the torques do not say what the wrench is.
    pub fn wrench_of_torques<S: Divide>(
        self,
        arm: &Arm<S>,
        at: &At<S>,
        [tau, damping]: [&[S]; 2],
        moves: &[bool],
    ) -> Vec<S> {
        let j = self.moving_jacobian(arm, at, moves);
        let matrix = damped(&squared(&j), &damping[0]);
        Factor::new(&matrix).solve(&products(&j, tau))
    }

    /// Returns J of the components that are asked for, zero of joints that do not move.
    pub fn moving_jacobian<S: Scalar>(self, arm: &Arm<S>, at: &At<S>, moves: &[bool]) -> Matrix<S> {
        let mut j = self.gathered_jacobian(arm, at);
        hold(&mut j, moves);
        j
    }
}

/// Returns J Jᵀ
pub fn squared<S: Scalar>(j: &[Vec<S>]) -> Matrix<S> {
    symmetric(j.len(), |i, k| product(&j[i], &j[k]))
}

fn along_links<S: Scalar>(arm: &Arm<S>, at: &At<S>, wrench: &[S]) -> Vec<S> {
    let (arm, at) = arm.to_hand(at);
    let at = &*at;
    let [force, moment] = parts(wrench);
    let wrench = Wrench { force, moment };
    match arm.frames.axes {
        Axes::Local => from_the_hand(&arm, at, wrench),
        Axes::World => from_the_base(&arm, at, wrench),
        Axes::Mixed => {
            let hand = Formulation::NewtonEulerLink.hand(&arm, at);
            let moment = sum(&wrench.moment, &cross(&hand.origin, &wrench.force));
            from_the_base(&arm, at, Wrench { moment, ..wrench })
        }
    }
}

fn from_the_hand<S: Scalar>(arm: &Arm<S>, at: &At<S>, wrench: Wrench<S>) -> Vec<S> {
    let mut wrench = match &arm.tool {
        None => wrench,
        Some(tool) => wrench.carried(|v| tool.rotate(v), &tool.origin),
    };
    from_hand(arm.steps(at), |step| {
        let inner = wrench.carried(|v| step.to_previous(v), &step.lever());
        let at_joint = step.at_joint(&inner, &wrench);
        let torque = at_joint.part(step.link.kind)[2].clone();
        wrench = inner;
        torque
    })
}

/// From the base outward; the wrench is about the base's origin in base axes.
fn from_the_base<S: Scalar>(arm: &Arm<S>, at: &At<S>, wrench: Wrench<S>) -> Vec<S> {
    let outward = |wrench: &Wrench<S>, origin: &Vector<S>| Wrench {
        moment: difference(&wrench.moment, &cross(origin, &wrench.force)),
        force: wrench.force.clone(),
    };
    let mut wrench = match &arm.base {
        None => wrench,
        Some(base) => outward(&wrench, &base.origin).in_axes(|v| base.rotate_back(v)),
    };
    let torques = arm.steps(at).map(|step| {
        let outer = outward(&wrench, &step.lever()).in_axes(|v| step.to_link(v));
        let at_joint = step.at_joint(&wrench, &outer);
        let torque = at_joint.part(step.link.kind)[2].clone();
        wrench = outer;
        torque
    });
    torques.collect()
}

impl Formulation {
    /// Returns J of the points in contact, 3k×n, in base axes.
    pub fn contact_jacobians<S: Scalar>(self, arm: &Arm<S>, at: &At<S>) -> Matrix<S> {
        let points = arm.in_contact().into_iter();
        let rows = points.flat_map(|arm| self.gathered_jacobian(&arm, at));
        rows.collect()
    }

    /// Returns J̇q̇ of the points in contact, 3k: their accelerations where those of joints are zero.
    pub fn contact_bias<S: Scalar>(self, arm: &Arm<S>, at: &At<S>, qd: &[S]) -> Vec<S> {
        let points = arm.in_contact().into_iter();
        let rates = points.map(|arm| self.jacobian_rate(&arm, at, qd)[0].clone());
        rates.flatten().collect()
    }

    /// Returns J D⁻¹ Jᵀ + λ² 1 of the points in contact, J D⁻¹, and what the points would accelerate
    /// by if nothing held them.
    pub fn contact_space<S: Divide>(
        self,
        arm: &Arm<S>,
        at: &At<S>,
        [qd, tau, damping]: [&[S]; 3],
        moves: &[bool],
    ) -> ContactSpace<S> {
        let jacobian = self.contact_jacobians(arm, at);
        let inverse = self.inertia_inverse(arm, at, moves);
        let accelerations = self.forward_dynamics(arm, at, qd, tau, moves);
        let driven_points = products(&jacobian, &accelerations);
        let escape = sums(&driven_points, &self.contact_bias(arm, at, qd));
        let driven: Matrix<S> = jacobian.iter().map(|row| products(&inverse, row)).collect();
        let mobility = symmetric(jacobian.len(), |i, k| product(&driven[i], &jacobian[k]));
        ContactSpace {
            matrix: damped(&mobility, &damping[0]),
            driven,
            escape,
            accelerations,
        }
    }
}

/// Points that something holds by forces f: (J D⁻¹ Jᵀ + λ² 1) f = −(J q̈₀ + J̇q̇), with q̈₀ the
/// accelerations without forces.
#[derive(Clone, Debug)]
pub struct ContactSpace<S> {
    /// J D⁻¹ Jᵀ + λ² 1, 3k×3k.
    pub matrix: Matrix<S>,
    /// J D⁻¹, 3k×n.
    driven: Matrix<S>,
    /// J q̈₀ + J̇q̇
    pub escape: Vec<S>,
    /// q̈₀
    accelerations: Vec<S>,
}

impl<S: Divide> ContactSpace<S> {
    /// Returns the forces on the points, 3k.
    pub fn forces(&self) -> Vec<S> {
        let forces = Factor::new(&self.matrix).solve(&self.escape);
        forces.iter().map(negative).collect()
    }

    /// Returns q̈
    pub fn accelerations(&self) -> Vec<S> {
        let more = products(&columns_of(&self.driven), &self.forces());
        sums(&self.accelerations, &more)
    }
}

/// Returns q̈ and the forces on points, from J, J̇q̇ and the factors of D over the joints that move;
/// `load` drives them from accelerations `reference`. With X = U⁻¹ Jᵀ and y = U⁻¹ b it is one
/// substitution: D⁻¹ (b + Jᵀ f) = U⁻ᵀ d⁻¹ (y + X f).
pub fn held<S: Divide>(
    (jacobian, rate): (&[Vec<S>], &[S]),
    factor: &Factor<S>,
    [load, reference]: [&[S]; 2],
    damping: &S,
    moves: &[bool],
) -> [Vec<S>; 2] {
    let joints = free(moves);
    let halves = factor.eliminated_rows(jacobian, &joints);
    let half_load = factor.eliminated(&picked(load, &joints));
    let scaled: Matrix<S> = halves.iter().map(|half| factor.scaled(half)).collect();
    let mobility = symmetric(jacobian.len(), |i, k| product(&scaled[i], &halves[k]));
    let by_load = products(&scaled, &half_load);
    let driven_points = sums(&by_load, &products(jacobian, reference));
    let escape = sums(&driven_points, rate);
    let opposite_forces = Factor::new(&damped(&mobility, damping)).solve(&escape);
    let forces: Vec<S> = opposite_forces.iter().map(negative).collect();
    let pushed = sums(&half_load, &products(&columns_of(&halves), &forces));
    let driven = factor.substituted(factor.scaled(&pushed));
    let accelerations = sums(reference, &scatter(&driven, &joints, moves.len()));
    [accelerations, forces]
}
