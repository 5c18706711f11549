//! Forward dynamics of a chain whose last joint turns about a principal axis.
//!
//! The couple is that of the link's own turn. The tensor's part that is symmetric about the
//! axis gives J ω_z (ω × z); the rest, I_δ, has no trace and no component along the
//! axis, and with ω′ of the frame before gives e = z·(ω′ × I_δ ω′), the part along the axis
//! that velocities alone ask for, and 2 q̇_n z × I_δ ω′.

use alloc::vec::Vec;

use super::composite::{Composite, CompositeOrder};
use super::recursion::ReferenceMotion;
use super::{Chain, ChainLink, Displacement, Form, MomentBody, Posture, Unknowns};
use crate::equations::SinCosPair;
use crate::equations::forward::inverted;
use crate::equations::matrix::*;
use crate::robot::JointKind;
use crate::scalar::{Divide, Scalar};

/// A chain without its last joint, which turns about a principal axis of its link.
#[derive(Clone, Debug)]
pub struct EliminatedTip<'a, S> {
    whole: &'a Composite<'a, S>,
    /// The joints before; the last link is fixed to theirs.
    chain: Chain<S>,
    /// The last link with what is left about the axis, in the axes that it turns from.
    link: MomentBody<S>,
    /// J
    inertia: S,
    /// 1/(J + A)
    inverse: S,
    /// J/(J + A)
    share: S,
    /// A J/(J + A)
    rest: S,
}

impl<'a, S: Divide> EliminatedTip<'a, S> {
    /// Eliminates the tip of a chain, if its last joint moves, is not the only one and turns about
    /// a principal axis. J + A is its entry of D, a constant above zero where D has an inverse.
    pub fn new(whole: &'a Composite<'a, S>, moves: &[bool]) -> Option<Self> {
        let (link, inner) = whole.chain.links.split_last()?;
        let Displacement::Turn(theta) = whole.at.last()? else {
            return None;
        };
        let is_alone = inner.is_empty() || !whole.chain.is_serial();
        if is_alone || moves.last() != Some(&true) || !link.turns_about_principal_axis() {
            return None;
        }
        let second = &link.body.second;
        let inertia = plus(&second.xx, &second.yy);
        let inverse = over(&S::one(), &plus(&inertia, &link.armature));
        // Without a rotor nothing is left, and no rounding of J/J either.
        let [share, rest] = match link.armature.is_zero() {
            true => [S::one(), S::zero()],
            false => {
                let share = times(&inertia, &inverse);
                [share.clone(), times(&share, &link.armature)]
            }
        };
        let mut body = link.body.clone();
        let taken = halved(&minus(&inertia, &rest));
        body.second.xx = minus(&second.xx, &taken);
        body.second.yy = minus(&second.yy, &taken);
        body.second.zz = plus(&second.zz, &taken);
        let body = body.turned_z(theta);
        let mut chain = whole.chain.clone();
        chain.links.pop();
        if let Some(last) = chain.links.last_mut() {
            let fixed = body.carried(&link.rotation, &link.offset);
            last.body = last.body.with(&fixed);
        }
        Some(EliminatedTip {
            whole,
            chain,
            link: body,
            inertia,
            inverse,
            share,
            rest,
        })
    }

    fn at(&self) -> &Posture<S> {
        &self.whole.at[..self.chain.links.len()]
    }

    fn brought(&self) -> Vec<S> {
        let last = self.chain.links.len();
        let along = |i: usize| self.whole.twist(i, last).turn[2].clone();
        (0..last).map(along).collect()
    }

    /// Returns the rest of the couple of the joint before on the last link, in the axes that this
    /// turns from, and e: of ω′ before, the joint's rate and what of its torque friction leaves.
    fn couple(&self, [x, y, z]: &Vector<S>, rate: &S, left: &S) -> (Vector<S>, S) {
        let second = &self.link.second;
        // I_δ ω′: of Σ half the difference, and Σ_xy.
        let half = halved(&minus(&second.xx, &second.yy));
        let spread = [
            negative(&plus(&times(&half, x), &times(&second.xy, y))),
            minus(&times(&half, y), &times(&second.xy, x)),
        ];
        let spin_torque = minus(&times(x, &spread[1]), &times(y, &spread[0]));
        let momentum = minus(&times(&self.inertia, &plus(z, rate)), &times(&self.rest, z));
        let double = twice(rate);
        let couple = [
            minus(&times(&momentum, y), &times(&double, &spread[1])),
            minus(&times(&double, &spread[0]), &times(&momentum, x)),
            times(&self.share, &minus(left, &spin_torque)),
        ];
        (couple, spin_torque)
    }

    /// Returns q̈ under τ, zero of joints that do not move.
    pub fn forward_dynamics(
        &self,
        [qd, tau]: [&[S]; 2],
        moves: &[bool],
        form: Form,
        unknowns: Unknowns,
    ) -> Vec<S> {
        let (chain, at, last) = (&self.chain, self.at(), self.chain.links.len());
        let link = &self.whole.chain.links[last];
        let (before, loads, moves) = (&qd[..last], &tau[..last], &moves[..last]);
        let motion = match form.composite_h {
            false => chain.reference_motion(at, before, moves, form.spin),
            true => ReferenceMotion {
                accelerations: zeros(last),
                motions: chain.motions(at, before, &zeros(last), form.spin),
            },
        };
        let (motions, reference) = (&motion.motions, &motion.accelerations);
        let tip = &motions.links[last - 1];
        let unturned = Displacement::Turn(SinCosPair::straight());
        let omega = link.inward(&unturned, &tip.omega);
        let left = minus(&tau[last], &link.friction.torque(&qd[last]));
        let (couple, spin_torque) = self.couple(&omega, &qd[last], &left);
        let couple = link.outward(&unturned, &couple);
        let left = minus(&left, &spin_torque);
        let composite = Composite::new(chain, at);
        let drive = |i: usize| chain.drive(i, qd, reference);
        let rest = match form.shoulder.then(|| chain.shoulder()).flatten() {
            None => {
                let bias = match form.composite_h {
                    false => chain.torques(at, motions, form.couple, &couple, drive),
                    true => {
                        let (gravity, rest) = (&chain.gravity, zeros(last));
                        let loads = composite.torques(gravity, before, &rest, form.spin, &couple);
                        chain.driven(loads, qd, reference)
                    }
                };
                let d = composite.inertia(form.travel);
                chain.accelerations(&d, [&bias, loads], moves, (form, unknowns))
            }
            Some(heights) => {
                let (exerted, inputs) = ((form, &couple), [before, loads]);
                composite.accelerations_by_shoulder(&heights, &motion, exerted, inputs, moves)
            }
        };
        let still = dot(&link.axis_before(), &tip.omega_dot);
        let brought = plus(&still, &product(&self.brought(), &rest));
        let mut qdd = sums(&rest, reference);
        let free_acceleration = times(&left, &self.inverse);
        qdd.push(minus(&free_acceleration, &times(&self.share, &brought)));
        qdd
    }

    /// Returns D⁻¹; zero in the rows and columns of joints that do not move.
    pub fn inertia_inverse(&self, moves: &[bool], travel: CompositeOrder) -> Matrix<S> {
        let last = self.chain.links.len();
        let d = Composite::new(&self.chain, self.at()).inertia(travel);
        let inner = inverted(&d, &moves[..last]);
        let brought = self.brought();
        let share = |row: &[S]| times(&self.share, &product(row, &brought));
        let border: Vec<S> = inner.iter().map(|row| negative(&share(row))).collect();
        let corner = minus(&self.inverse, &share(&border));
        symmetric(last + 1, |i, k| match (i == last, k == last) {
            (true, true) => corner.clone(),
            (true, false) => border[k].clone(),
            (false, true) => border[i].clone(),
            (false, false) => inner[i][k].clone(),
        })
    }
}

impl<S: Scalar> ChainLink<S> {
    /// The axis passes through the centre of mass. By structure, not by value.
    fn turns_about_principal_axis(&self) -> bool {
        let (body, second) = (&self.body, &self.body.second);
        let across = [&body.first[0], &body.first[1], &second.xz, &second.yz];
        self.kind == JointKind::Revolute && across.into_iter().all(S::is_zero)
    }
}
