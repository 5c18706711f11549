//! C from composite momenta: half of the slopes of h by velocities.

use alloc::vec::Vec;

use super::composite::{Composite, CompositeOrder};
use super::derivatives::{Flow, inertial, rate};
use crate::equations::matrix::{dot, plus};
use crate::equations::screws::{Twist, Wrench};
use crate::scalar::Scalar;

/// The contribution of one joint and its composite body.
struct Joint<S> {
    /// The rate of the joint's twist.
    rate: Twist<S>,
    /// The wrench of a unit acceleration.
    push: Wrench<S>,
    /// Half of what the joints before feel for each unit of its velocity.
    felt: Wrench<S>,
    /// Half of what the rate of the composite gives along the joint for each turn
    /// of all that it is part of.
    swing: [S; 3],
}

impl<S: Scalar> Composite<'_, S> {
    /// Returns C, n×n, by composite momenta.
    pub fn coriolis_matrix(&self, qd: &[S], travel: CompositeOrder) -> Vec<Vec<S>> {
        let joints = self.velocity_parts(qd);
        let n = joints.len();
        let mut matrix = alloc::vec![alloc::vec![S::zero(); n]; n];
        for (i, own) in joints.iter().enumerate() {
            matrix[i][i] = own.felt.along(&self.twist(i, i));
            match travel {
                CompositeOrder::Inward => self.inward(i, &joints, &mut matrix),
                CompositeOrder::Outward => self.outward(i, &joints, &mut matrix),
            }
        }
        self.matrix_in_metres(&mut matrix);
        matrix
    }

    /// Wrenches of joint i come in to the joints before it.
    fn inward(&self, i: usize, joints: &[Joint<S>], matrix: &mut [Vec<S>]) {
        let mut wrenches = [joints[i].felt.clone(), joints[i].push.clone()];
        let mut swing = joints[i].swing.clone();
        for j in (0..i).rev() {
            wrenches = wrenches.map(|wrench| self.chain.to_previous(j + 1, self.at, &wrench));
            swing = self.chain.links[j + 1].outward(&self.at[j + 1], &swing);
            let ([felt, push], twist) = (&wrenches, self.twist(j, j));
            matrix[j][i] = felt.along(&twist);
            matrix[i][j] = plus(&dot(&swing, &twist.turn), &push.along(&joints[j].rate));
        }
    }

    /// Twists of the joints before i, and how they change, go out to frame i.
    fn outward(&self, i: usize, joints: &[Joint<S>], matrix: &mut [Vec<S>]) {
        let own = &joints[i];
        for (j, joint) in joints.iter().enumerate().take(i) {
            let twist = self.twist(j, i);
            let rate = self.twist_outward(&joint.rate, j, i);
            matrix[j][i] = own.felt.along(&twist);
            matrix[i][j] = plus(&dot(&own.swing, &twist.turn), &own.push.along(&rate));
        }
    }

    /// Returns what each joint contributes by itself, from the hand inward.
    fn velocity_parts(&self, qd: &[S]) -> Vec<Joint<S>> {
        let chain = self.chain;
        let velocities = chain.velocities(self.at, qd);
        let mut flow = Flow::nothing();
        let mut joints = Vec::with_capacity(chain.links.len());
        for (i, link) in chain.links.iter().enumerate().rev() {
            flow = flow.with(&Flow::of(&link.body, &velocities[i]));
            let rate = rate(link, &velocities[i]);
            let push = self.momentum(i);
            let turn = self.twist(i, i).turn;
            joints.push(Joint {
                push,
                felt: flow
                    .half_of_turn(&turn)
                    .with(&inertial(&self.bodies[i], &rate)),
                swing: flow.half_swing(link),
                rate,
            });
            flow = flow.carried(link, &self.at[i]);
        }
        joints.reverse();
        joints
    }
}
