//! C from composite momenta: half of the slopes of h by velocities.

use alloc::vec::Vec;

use super::composite::{Acting, Composite, CompositeOrder};
use super::derivatives::{Flow, inertial, rate};
use crate::equations::matrix::{dot, plus};
use crate::equations::screws::Twist;
use crate::scalar::Scalar;

/// The twist of a joint and its rate.
type Earlier<S> = [Twist<S>; 2];

/// For a joint with its composite: half of the wrench per unit velocity that the joints before
/// feel, the wrench of a unit acceleration, and half of the composite's rate along the joint per
/// turn.
type Later<S> = Acting<S, 2, 1>;

impl<S: Scalar> Composite<'_, S> {
    /// Returns C, n×n, by composite momenta.
    pub fn coriolis_matrix(&self, qd: &[S], travel: CompositeOrder) -> Vec<Vec<S>> {
        let (earlier, later) = self.velocity_parts(qd);
        let n = later.len();
        let mut matrix = alloc::vec![alloc::vec![S::zero(); n]; n];
        self.each_pair(travel, &earlier, later, |[j, i], [twist, rate], own| {
            let ([felt, push], [swing]) = (&own.wrenches, &own.vectors);
            matrix[j][i] = felt.along(twist);
            if j < i {
                matrix[i][j] = plus(&dot(swing, &twist.turn), &push.along(rate));
            }
        });
        self.matrix_in_metres(&mut matrix);
        matrix
    }

    fn velocity_parts(&self, qd: &[S]) -> (Vec<Earlier<S>>, Vec<Later<S>>) {
        let chain = self.chain;
        let velocities = chain.velocities(self.at, qd);
        let mut flow = Flow::nothing();
        let mut joints = Vec::with_capacity(chain.links.len());
        for (i, link) in chain.links.iter().enumerate().rev() {
            flow = flow.with(&Flow::of(&link.body, &velocities[i]));
            let rate = rate(link, &velocities[i]);
            let push = self.momentum(i);
            let twist = self.twist(i, i);
            let felt = flow.half_of_turn(&twist.turn);
            let felt = felt.with(&inertial(&self.bodies[i], &rate));
            let acting = Acting {
                wrenches: [felt, push],
                vectors: [flow.half_swing(link)],
            };
            joints.push(([twist, rate], acting));
            flow = flow.carried(link, &self.at[i]);
        }
        joints.into_iter().rev().unzip()
    }
}
