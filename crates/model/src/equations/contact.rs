//! What a wrench that acts on the hand is to the joints, and the other way round.
//!
//! A wrench is the force and the moment that something else exerts on the hand, about the
//! point and in the axes of the arm's [`Axes`]: that in which J has the velocity. It does
//! the work of the torques Jᵀ w.

use alloc::vec::Vec;

use super::factor::Factor;
use super::frames::Axes;
use super::matrix::{
    Columns, Vector, columns_of, cross, difference, product, products, sum, symmetric, three,
};
use super::operational::damped;
use super::screws::Wrench;
use super::{Arm, DhVariables, Formulation};
use crate::robot::Convention;
use crate::scalar::{Divide, Scalar};

impl Formulation {
    /// Returns Jᵀ w of a wrench of six components, a torque or force a joint: the recursions in
    /// link axes carry the wrench along the chain, the others multiply by J.
    pub fn torques_of_wrench<S: Scalar>(
        self,
        arm: &Arm<S>,
        at: &[DhVariables<S>],
        wrench: &[S],
    ) -> Vec<S> {
        match self {
            Self::NewtonEulerLink | Self::NewtonEulerLinkDifferences => {
                let mut torques = along_links(arm, at, wrench);
                torques.resize(at.len(), S::zero());
                torques
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
        at: &[DhVariables<S>],
        [tau, damping]: [&[S]; 2],
        moves: &[bool],
    ) -> Vec<S> {
        let j = self.moving_jacobian(arm, at, moves);
        let matrix = damped(&squared(&j), &damping[0]);
        Factor::new(&matrix).solve(&products(&j, tau))
    }

    /// Returns J of the components that are asked for, zero of joints that do not move.
    pub fn moving_jacobian<S: Scalar>(
        self,
        arm: &Arm<S>,
        at: &[DhVariables<S>],
        moves: &[bool],
    ) -> Vec<Vec<S>> {
        let mut j = self.gathered_jacobian(arm, at);
        for row in &mut j {
            for (entry, _) in row.iter_mut().zip(moves).filter(|(_, moves)| !**moves) {
                *entry = S::zero();
            }
        }
        j
    }
}

/// Returns J Jᵀ
pub fn squared<S: Scalar>(j: &[Vec<S>]) -> Vec<Vec<S>> {
    symmetric(j.len(), |i, k| product(&j[i], &j[k]))
}

fn along_links<S: Scalar>(arm: &Arm<S>, at: &[DhVariables<S>], wrench: &[S]) -> Vec<S> {
    let (arm, at) = arm.to_hand(at);
    let part = |from: usize| -> Vector<S> { three(|i| wrench[from + i].clone()) };
    let wrench = Wrench {
        force: part(0),
        moment: part(3),
    };
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

fn from_the_hand<S: Scalar>(arm: &Arm<S>, at: &[DhVariables<S>], wrench: Wrench<S>) -> Vec<S> {
    let mut wrench = match &arm.tool {
        None => wrench,
        Some(tool) => wrench.carried(|v| tool.rotate(v), &tool.origin),
    };
    let mut torques = Vec::with_capacity(at.len());
    for (link, at) in arm.links.iter().zip(at).rev() {
        let step = link.append(arm.convention, at, &Columns::identity());
        let turn = |v: &Vector<S>| link.to_previous(arm.convention, at, v);
        let inner = wrench.carried(turn, &step.origin);
        let at_joint = match arm.convention {
            Convention::Standard => &inner,
            Convention::Modified => &wrench,
        };
        torques.push(at_joint.part(link.kind)[2].clone());
        wrench = inner;
    }
    torques.reverse();
    torques
}

/// From the base outward; the wrench is about the base's origin in base axes.
fn from_the_base<S: Scalar>(arm: &Arm<S>, at: &[DhVariables<S>], wrench: Wrench<S>) -> Vec<S> {
    let outward = |wrench: &Wrench<S>, origin: &Vector<S>| Wrench {
        moment: difference(&wrench.moment, &cross(origin, &wrench.force)),
        force: wrench.force.clone(),
    };
    let mut wrench = match &arm.base {
        None => wrench,
        Some(base) => outward(&wrench, &base.origin).in_axes(|v| base.rotate_back(v)),
    };
    let mut torques = Vec::with_capacity(at.len());
    for (link, at) in arm.links.iter().zip(at) {
        let before = wrench;
        let step = link.append(arm.convention, at, &Columns::identity());
        let turn = |v: &Vector<S>| link.to_link(arm.convention, at, v);
        wrench = outward(&before, &step.origin).in_axes(turn);
        let at_joint = match arm.convention {
            Convention::Standard => &before,
            Convention::Modified => &wrench,
        };
        torques.push(at_joint.part(link.kind)[2].clone());
    }
    torques
}
