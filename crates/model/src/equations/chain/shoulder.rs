//! Forward dynamics of a chain whose first three joints or more turn about axes that meet.
//!
//! In I ω̇ + N ÿ = μ − p and Nᵀ ω̇ + D ÿ = τ − b, with I the inertia of all links beyond about the
//! point and N the moments about it of their unit accelerations, in the axes of the first link
//! beyond, ÿ is eliminated; what is left is an articulated body that only turns.

use alloc::vec::Vec;

use super::body::entry;
use super::composite::{Composite, CompositeOrder};
use super::recursion::ReferenceMotion;
use super::{Chain, ChainLink, Displacement, Form, MomentBody, Posture, apply, apply_transposed};
use crate::equations::factor::{Factor, picked, placed};
use crate::equations::forward::free;
use crate::equations::matrix::*;
use crate::equations::screws::Wrench;
use crate::robot::{Inertia, JointKind};
use crate::scalar::{Divide, Scalar};

/// The fewest axes that have to meet: of two, as much work is left as without.
const FEWEST: usize = 3;

/// The fewest joints beyond: of one, as much work is left as without.
const BEYOND: usize = 2;

impl<S: Scalar> Chain<S> {
    /// True if three axes or more meet at the base, by structure, with two joints beyond.
    pub fn has_shoulder(&self) -> bool {
        self.shoulder().is_some()
    }

    /// Finds the joints at the base whose axes meet: the height of each frame over the point.
    pub(super) fn shoulder(&self) -> Option<Vec<S>> {
        let count = self.links.len();
        let most = count.checked_sub(BEYOND).filter(|_| self.is_serial())?;
        let mut candidates = (0..FEWEST).filter_map(|origin| self.through(origin));
        // Through two points that are not one there is one axis at most.
        candidates.find(|heights| (FEWEST..=most).contains(&heights.len()))
    }

    /// Turning about an axis leaves what is on it where it is.
    fn through(&self, origin: usize) -> Option<Vec<S>> {
        let turns = |link: &ChainLink<S>| link.kind == JointKind::Revolute;
        let height = |point: &Vector<S>| {
            let is_on_axis = point[0].is_zero() && point[1].is_zero();
            is_on_axis.then(|| point[2].clone())
        };
        let mut heights = alloc::vec![S::zero()];
        for link in self.links.get(1..=origin)?.iter().rev() {
            let along = [S::zero(), S::zero(), negative(&heights[0])];
            let point = sum(&apply(&link.rotation, &along), &link.offset);
            heights.insert(0, negative(&height(&point)?));
        }
        let (inner, outer) = self.links.split_at(origin + 1);
        if !inner.iter().all(turns) {
            return None;
        }
        for link in outer.iter().take_while(|link| turns(link)) {
            let along = [S::zero(), S::zero(), heights[heights.len() - 1].clone()];
            let point = apply_transposed(&link.rotation, &sum(&along, &link.offset));
            match height(&point) {
                Some(height) => heights.push(height),
                None => break,
            }
        }
        Some(heights)
    }

    /// Returns the origin of the first frame beyond, seen from the point in the axes of that frame.
    fn lever_beyond(&self, heights: &[S], at: &Posture<S>) -> Vector<S> {
        let first = heights.len();
        let along = [S::zero(), S::zero(), heights[first - 1].clone()];
        let (link, at) = (&self.links[first], &at[first]);
        link.inward(at, &sum(&along, &link.lever(at)))
    }
}

impl<S: Divide> Composite<'_, S> {
    /// Returns q̈ under τ, zero of what does not move, if the form asks and there is a shoulder.
    pub fn forward_dynamics_by_shoulder(
        &self,
        [qd, tau]: [&[S]; 2],
        moves: &[bool],
        form: Form,
    ) -> Option<Vec<S>> {
        let heights = form.shoulder.then(|| self.chain.shoulder()).flatten()?;
        let motion = (self.chain).reference_motion(self.at, qd, moves, form.spin);
        let exerted = (form, &zero_vector());
        let rest = self.accelerations_by_shoulder(&heights, &motion, exerted, [qd, tau], moves);
        Some(sums(&rest, &motion.accelerations))
    }

    /// Returns q̈ beyond a reference under τ; the last link exerts a moment on something else.
    pub(super) fn accelerations_by_shoulder(
        &self,
        heights: &[S],
        reference: &ReferenceMotion<S>,
        (form, exerted): (Form, &Vector<S>),
        [qd, tau]: [&[S]; 2],
        moves: &[bool],
    ) -> Vec<S> {
        let chain = self.chain;
        let (first, n) = (heights.len(), chain.links.len());
        let lever = chain.lever_beyond(heights, self.at);
        let drive = |i: usize| chain.drive(i, qd, &reference.accelerations);
        let wrench =
            |i: usize| reference.motions.links[i].wrench(&chain.links[i].body, form.couple);

        let mut felt = Wrench::couple(exerted.clone());
        let mut left = zeros(n);
        for i in (first..n).rev() {
            felt = felt.with(&wrench(i));
            let load = chain.load(i, &felt);
            left[i] = minus(&tau[i], &plus(&load, &drive(i)));
            if i > first {
                felt = chain.to_previous(i, self.at, &felt);
            }
        }
        let lifted = cross(&lever, &felt.force);
        let mut moment = sum(&felt.moment, &lifted);
        let is_taken_back = chain.links[first].kind == JointKind::Revolute && moves[first];
        if is_taken_back {
            // Along its axis the joint passes on what it is given.
            moment[2] = plus(&lifted[2], &minus(&tau[first], &drive(first)));
        }
        let mut matrix = self.beyond(first, &lever, moves, form.travel);
        if is_taken_back {
            matrix = taken_back(matrix);
        }
        let beyond = Factor::partial(&matrix, 3);
        let joints: Vec<usize> = free(moves).into_iter().filter(|&i| i >= first).collect();
        let right = moment.iter().map(negative).chain(picked(&left, &joints));
        let right = beyond.halfway(&right.collect::<Vec<S>>());
        let (about, rest) = right.split_at(3);
        let inertia = Inertia::symmetric(|i, k| beyond.left(k, i).clone());
        let moment = three(|axis| negative(&about[axis]));
        let mut hinged = HingedBody { inertia, moment };
        hinged = hinged.carried(&chain.links[first], &self.at[first]);

        let solved = from_hand(chain.links[..first].iter().enumerate(), |(i, link)| {
            hinged = hinged.with(&link.body, &heights[i], &wrench(i));
            let mut solution = None;
            if moves[i] {
                let torque = minus(&tau[i], &drive(i));
                let is_first = !moves[..i].contains(&true);
                let (rest, joint) = hinged.eliminated(&link.armature, &torque, is_first);
                (hinged, solution) = (rest, Some(joint));
            }
            hinged = hinged.carried(link, &self.at[i]);
            solution
        });
        let mut hinge_accelerations = zeros(n);
        let mut omega = zero_vector();
        for (i, joint) in solved.iter().enumerate() {
            omega = chain.links[i].inward(&self.at[i], &omega);
            if let Some((acceleration, shares)) = joint {
                let [x, y] = [0, 1].map(|axis| times(&shares[axis], &omega[axis]));
                let turn_acceleration = minus(&minus(acceleration, &x), &y);
                hinge_accelerations[i] = minus(&turn_acceleration, &times(&shares[2], &omega[2]));
                omega[2] = match chain.links[i].armature.is_zero() {
                    true => turn_acceleration,
                    false => plus(&omega[2], &hinge_accelerations[i]),
                };
            }
        }
        let omega = chain.links[first].inward(&self.at[first], &omega);
        let known = omega.into_iter().chain(rest.iter().cloned()).collect();
        let all_accelerations = beyond.substituted(known);
        let of_joints = all_accelerations[3..].iter().cloned();
        let mut accelerations = placed(hinge_accelerations, &joints, of_joints);
        if is_taken_back {
            accelerations[first] = minus(&accelerations[first], &all_accelerations[2]);
        }
        accelerations
    }

    /// Returns I, N and D of the joints that move beyond a shoulder; a lever to the first frame.
    fn beyond(
        &self,
        first: usize,
        lever: &Vector<S>,
        moves: &[bool],
        travel: CompositeOrder,
    ) -> Matrix<S> {
        let chain = self.chain;
        let tensor = self.bodies[first].moved(lever).tensor().rows();
        let mut lower: Matrix<S> = (0..3).map(|i| tensor[i][..=i].to_vec()).collect();
        for k in (first..chain.links.len()).filter(|&k| moves[k]) {
            let momentum = self.momentum(k);
            let mut wrench = momentum.clone();
            let mut row = Vec::new();
            for i in (first..=k).rev() {
                let load = match travel {
                    CompositeOrder::Inward => chain.load(i, &wrench),
                    CompositeOrder::Outward => self.project(i, k, &momentum),
                };
                let load = chain.rescaled(k, load);
                if i == k {
                    row.push(plus(&load, &chain.links[k].armature));
                } else if moves[i] {
                    row.push(load);
                }
                if i > first {
                    wrench = chain.to_previous(i, self.at, &wrench);
                }
            }
            let moment = sum(&wrench.moment, &cross(lever, &wrench.force));
            row.extend(moment.iter().rev().map(|x| chain.rescaled(k, x.clone())));
            row.reverse();
            lower.push(row);
        }
        symmetric(lower.len(), |i, k| lower[i.max(k)][i.min(k)].clone())
    }
}

/// Returns it where the first joint beyond takes back what ω̇ has along its axis, as in
/// `parallel`: then all beyond moves without a turn, and that is forces on a lever.
fn taken_back<S: Scalar>(mut matrix: Matrix<S>) -> Matrix<S> {
    let rows = matrix[2].iter().zip(&matrix[3]);
    matrix[2] = rows.map(|(x, y)| minus(x, y)).collect();
    for row in &mut matrix {
        row[2] = minus(&row[2], &row[3]);
    }
    matrix
}

/// Articulated bodies that only turn, about a point that stays where it is: a moment I ω̇ + p about
/// it, in the axes of a frame, is what the joints of a shoulder feel of all that is beyond them.
///
/// A joint about z that is given the torque τ turns with ω̇_z = w_z + q̈, w being what the
/// joints before bring along, so that D q̈ = τ − p_z − (I w)_z with D = I_zz + A, A its rotor.
/// The joints before feel I′ w + p′ with I′ = I − I_z I_zᵀ/D and p′ = p + I_z (τ − p_z)/D.
struct HingedBody<S> {
    inertia: Inertia<S>,
    moment: Vector<S>,
}

impl<S: Scalar> HingedBody<S> {
    fn carried(&self, link: &ChainLink<S>, at: &Displacement<S>) -> Self {
        // A tensor turns as second moments do.
        let mut body = MomentBody::zero();
        body.second = self.inertia.clone();
        let inertia = match at {
            Displacement::Turn(theta) => body.turned_z(theta).turned(&link.rotation).second,
            Displacement::Slide(_) => body.second,
        };
        let moment = link.outward(at, &self.moment);
        HingedBody { inertia, moment }
    }

    fn with(&self, body: &MomentBody<S>, height: &S, wrench: &Wrench<S>) -> Self {
        let lever = [S::zero(), S::zero(), height.clone()];
        let tensor = body.moved(&lever).tensor();
        let both = |i: usize, k: usize| plus(entry(&self.inertia, i, k), entry(&tensor, i, k));
        let inertia = Inertia::symmetric(both);
        let moment = sum(&wrench.moment, &cross(&lever, &wrench.force));
        let moment = sum(&self.moment, &moment);
        HingedBody { inertia, moment }
    }
}

impl<S: Divide> HingedBody<S> {
    /// Eliminates a joint about z with this rotor and torque; the first that moves divides alone.
    /// Returns (τ − p_z) / D, and I_xz / D, I_yz / D and I_zz / D, with the rest.
    fn eliminated(&self, rotor: &S, torque: &S, is_first: bool) -> (Self, (S, Vector<S>)) {
        let HingedBody { inertia, moment } = self;
        let pivot = plus(&inertia.zz, rotor);
        let inverse = over(&S::one(), &pivot);
        let left = minus(torque, &moment[2]);
        let [x, y] = [&inertia.xz, &inertia.yz].map(|entry| times(entry, &inverse));
        // Without a rotor nothing is left about the axis, and no rounding of it either.
        let z = match rotor.is_zero() {
            true => S::one(),
            false => times(&inertia.zz, &inverse),
        };
        let moment = [
            plus(&moment[0], &times(&x, &left)),
            plus(&moment[1], &times(&y, &left)),
            match rotor.is_zero() {
                true => torque.clone(),
                false => plus(&moment[2], &times(&z, &left)),
            },
        ];
        let inertia = Inertia {
            xx: minus(&inertia.xx, &times(&x, &inertia.xz)),
            yy: minus(&inertia.yy, &times(&y, &inertia.yz)),
            xy: minus(&inertia.xy, &times(&x, &inertia.yz)),
            xz: times(&x, rotor),
            yz: times(&y, rotor),
            zz: times(&z, rotor),
        };
        let acceleration = match is_first {
            true => over(&left, &pivot),
            false => times(&left, &inverse),
        };
        (HingedBody { inertia, moment }, (acceleration, [x, y, z]))
    }
}
