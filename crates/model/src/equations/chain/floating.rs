//! Forward dynamics of a tree on a floating base: D (a − a₀) = (W, τ) − (W, τ)(a₀) at accelerations
//! a₀ that shorten the recursion. The base falls freely and ω̇ makes U_12, U_23 and U_31 vanish;
//! joints are eliminated from the tips inward, so that nothing fills in between branches.

use alloc::vec::Vec;

use super::composite::{Composite, CompositeOrder};
use super::parallel::solved_in_pairs;
use super::recursion::{AccelerationForm, MomentForm, ReferenceMotion};
use super::{Chain, Displacement, Unknowns};
use crate::equations::matrix::*;
use crate::scalar::Divide;

/// The system that is solved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Solving {
    /// The base's linear acceleration is eliminated before its angular one.
    pub angular_last: bool,
    /// The unknowns that stand for q̈.
    pub unknowns: Unknowns,
    /// From accelerations that shorten the recursion, or from rest.
    pub reference: bool,
}

impl<S: Divide> Chain<S> {
    /// Returns the linear acceleration of the base's origin, ω̇ and q̈ under a wrench on the base
    /// (force over moment) and τ; the chain's gravity is gravity alone, and its ω̇ is not read.
    pub fn floating_forward(
        &self,
        at: &[Displacement<S>],
        qd: &[S],
        loads: &[S],
        (spin, couple, travel): (AccelerationForm, MomentForm, CompositeOrder),
        how: Solving,
    ) -> Vec<S> {
        let moves = alloc::vec![true; qd.len()];
        let omega = self.spin[0].clone();
        let [x, y, z] = &omega;
        let (fall, omega_dot) = match how.reference {
            true => (
                (self.gravity.each_ref()).map(|g| g.div(&self.per_unit)),
                [times(y, z), times(x, z), times(x, y)],
            ),
            false => (zero_vector(), zero_vector()),
        };
        let mut chain = self.clone();
        chain.spin[1] = omega_dot.clone();
        let motion = if how.reference {
            chain.gravity = zero_vector();
            chain.reference_motion(at, qd, &moves, spin)
        } else {
            let accelerations = zeros(qd.len());
            let links = chain.motions(at, qd, &accelerations, spin);
            ReferenceMotion {
                accelerations,
                links,
            }
        };
        let taken = chain.floating_loads(at, &motion.links, [qd, &motion.accelerations], couple);
        let d = Composite::new(&chain, at).floating_inertia(travel);
        // Unknowns are eliminated from the last on; the first six change places in halves.
        let order: Vec<usize> = match how.angular_last {
            true => [3, 4, 5, 0, 1, 2].into_iter().chain(6..d.len()).collect(),
            false => (0..d.len()).collect(),
        };
        let ordered = |values: &[S]| order.iter().map(|&i| values[i].clone()).collect::<Vec<S>>();
        let d: Vec<Vec<S>> = order.iter().map(|&i| ordered(&d[i])).collect();
        let mut pairs = match how.unknowns {
            Unknowns::Joints => Vec::new(),
            Unknowns::AgainstBase => chain.pairs(&moves),
        };
        for pair in &mut pairs {
            (pair.before, pair.after) = (6 + pair.before, 6 + pair.after);
        }
        let moves = alloc::vec![true; d.len()];
        let known = [&ordered(&taken)[..], &ordered(loads)];
        let found = solved_in_pairs(&pairs, &d, known, &moves);
        let reference = fall
            .into_iter()
            .chain(omega_dot)
            .chain(motion.accelerations);
        sums(&ordered(&found), &reference.collect::<Vec<S>>())
    }
}
