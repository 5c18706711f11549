//! The columns of a regressor: what bodies that are fixed to the links take of
//! torque, each by itself, at one motion; of the torques of a passivity-based
//! controller the same, at a motion with two velocities.
//!
//! An entry is the power of a body's wrench on a joint's twist. Where the axes of
//! several joints meet, the wrench may be taken about that point instead: N + F × o
//! once, and of each of these joints the angular part alone.

use alloc::vec::Vec;

use super::composite::CompositeOrder;
use super::probe::Probed;
use super::recursion::{AccelerationForm, MomentForm, Motion};
use super::{Chain, Displacement};
use crate::equations::matrix::{Vector, cross, difference, dot, sum, zero_vector, zeros};
use crate::equations::screws::Twist;
use crate::scalar::Scalar;

struct Centre<S> {
    joints: Vec<usize>,
    at: Vector<S>,
}

impl<S: Scalar> Chain<S> {
    /// Returns the columns that the probes are, a row a joint; by twists that travel
    /// outward alone, or by wrenches about points where axes meet.
    pub fn regressor(
        &self,
        at: &[Displacement<S>],
        qd: &[S],
        qdd: &[S],
        travel: CompositeOrder,
    ) -> Vec<Vec<S>> {
        let motions = self.motions(at, qd, qdd, AccelerationForm::Column);
        self.powers(at, &motions, [qd, qdd], travel)
    }

    /// Computes the regressor of D a + C v + c + b∘v.
    pub fn passivity_regressor(
        &self,
        at: &[Displacement<S>],
        qd: &[S],
        [v, a]: [&[S]; 2],
        travel: CompositeOrder,
    ) -> Vec<Vec<S>> {
        let motions = self.mixed_motions(at, qd, [v, a]);
        self.powers(at, &motions, [v, a], travel)
    }

    fn powers(
        &self,
        at: &[Displacement<S>],
        motions: &[Motion<S>],
        [rates, accelerations]: [&[S]; 2],
        travel: CompositeOrder,
    ) -> Vec<Vec<S>> {
        let n = self.links.len();
        let mut rows: Vec<Vec<S>> = (0..n).map(|_| zeros(self.columns)).collect();
        // The joints' twists up to the link's own, seen from its frame.
        let mut twists: Vec<Twist<S>> = Vec::with_capacity(n);
        let mut centres: Vec<Centre<S>> = Vec::new();
        for (i, link) in self.links.iter().enumerate() {
            twists = twists
                .iter()
                .map(|t| link.twist_outward(&at[i], t))
                .collect();
            twists.push(link.twist());
            for centre in &mut centres {
                let lever = link.lever(&at[i]);
                centre.at = link.inward(&at[i], &difference(&centre.at, &lever));
            }
            if travel == CompositeOrder::Inward {
                centres.extend(meeting(&twists));
            }
            for probe in &link.probes {
                let body = match &probe.of {
                    Probed::Armature => {
                        rows[i][probe.column] = accelerations[i].clone();
                        continue;
                    }
                    Probed::Viscous => {
                        rows[i][probe.column] = rates[i].clone();
                        continue;
                    }
                    Probed::Body(body) => body,
                };
                let wrench = motions[i].wrench(body, MomentForm::SecondMoments);
                let moments: Vec<Vector<S>> = centres
                    .iter()
                    .map(|centre| sum(&wrench.moment, &cross(&wrench.force, &centre.at)))
                    .collect();
                for (k, twist) in twists.iter().enumerate() {
                    let power = match widest(&centres, k) {
                        Some(centre) => dot(&twist.turn, &moments[centre]),
                        None => wrench.along(twist),
                    };
                    rows[k][probe.column] = self.rescaled(k, power);
                }
            }
        }
        rows
    }
}

fn meeting<S: Scalar>(twists: &[Twist<S>]) -> Option<Centre<S>> {
    let passes = |twist: &Twist<S>| {
        let turns = twist.turn.iter().any(|x| !x.is_zero());
        turns && twist.shift.iter().all(S::is_zero)
    };
    let joints = twists.iter().enumerate();
    let joints = joints.filter(|(_, twist)| passes(twist));
    let joints: Vec<usize> = joints.map(|(joint, _)| joint).collect();
    (joints.len() > 1).then(|| Centre {
        joints,
        at: zero_vector(),
    })
}

fn widest<S>(centres: &[Centre<S>], joint: usize) -> Option<usize> {
    let on_axis = centres.iter().enumerate();
    let on_axis = on_axis.filter(|(_, centre)| centre.joints.contains(&joint));
    let widest = on_axis.rev().max_by_key(|(_, centre)| centre.joints.len());
    widest.map(|(index, _)| index)
}
