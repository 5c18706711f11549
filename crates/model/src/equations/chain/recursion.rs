//! The customised Newton–Euler recursion, by U with U r = ω̇ × r + ω × (ω × r): a regrouped
//! link costs the few columns of U that its few moments need.

use alloc::vec::Vec;

use super::{Chain, ChainLink, Displacement, MomentBody, Posture};
use crate::equations::matrix::*;
use crate::equations::screws::Wrench;
use crate::robot::JointKind;
use crate::scalar::{Divide, Scalar};

/// The form of a link's U; the values are the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum AccelerationForm {
    /// The column along a revolute axis is the one before, turned: it does
    /// not depend on the joint's own motion. It gives ω̇_x, ω̇_y and ω_y².
    Column,
    /// ω̇ is propagated and U formed from it.
    Rates,
}

/// The form of the moment of a link's own motion; the values are the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum MomentForm {
    /// The antisymmetric part of U Σ.
    SecondMoments,
    /// I ω̇ + ω × (I ω).
    Euler,
}

/// The motion of one link, in its own axes.
#[derive(Clone, Debug)]
pub(super) struct LinkMotion<S> {
    pub(super) omega: Vector<S>,
    pub(super) omega_dot: Vector<S>,
    pub(super) u: [Vector<S>; 3],
    /// v̇ of the origin.
    pub(super) acceleration: Vector<S>,
}

impl<S: Scalar> LinkMotion<S> {
    pub(super) fn base([omega, omega_dot]: [Vector<S>; 2], acceleration: Vector<S>) -> Self {
        LinkMotion {
            u: from_rates(squares(&omega), &omega_dot),
            omega,
            omega_dot,
            acceleration,
        }
    }

    pub(super) fn u_times(&self, r: &Vector<S>) -> Vector<S> {
        let xy = sum(&scaled(&r[0], &self.u[0]), &scaled(&r[1], &self.u[1]));
        sum(&xy, &scaled(&r[2], &self.u[2]))
    }

    pub(super) fn next(
        &self,
        link: &ChainLink<S>,
        at: &Displacement<S>,
        rate: &S,
        acceleration: &S,
        spin: AccelerationForm,
    ) -> Self {
        match link.kind {
            JointKind::Prismatic => {
                let carried = sum(&self.acceleration, &self.u_times(&link.lever(at)));
                let axis = &link.axis;
                let coriolis = cross(&scaled(&twice(rate), &self.omega), axis);
                let mut next = self.clone();
                next.acceleration = sum(&sum(&carried, &coriolis), &scaled(acceleration, axis));
                next
            }
            JointKind::Revolute => {
                let carried = dot(&link.axis_before(), &self.omega_dot);
                self.next_along(link, at, rate, &plus(&carried, acceleration), spin)
            }
        }
    }

    pub(super) fn next_along(
        &self,
        link: &ChainLink<S>,
        at: &Displacement<S>,
        rate: &S,
        along: &S,
        spin: AccelerationForm,
    ) -> Self {
        let carried = sum(&self.acceleration, &self.u_times(&link.lever(at)));
        let turned = link.inward(at, &self.omega);
        let omega = [turned[0].clone(), turned[1].clone(), plus(&turned[2], rate)];
        let (omega_dot, u) = match spin {
            AccelerationForm::Column => {
                let column = link.inward(at, &self.u_times(&link.axis_before()));
                from_column(squares(&omega), along, column)
            }
            AccelerationForm::Rates => {
                let turned_dot = link.inward(at, &self.omega_dot);
                let omega_dot = [
                    plus(&turned_dot[0], &times(&omega[1], rate)),
                    minus(&turned_dot[1], &times(&omega[0], rate)),
                    along.clone(),
                ];
                let u = from_rates(squares(&omega), &omega_dot);
                (omega_dot, u)
            }
        };
        LinkMotion {
            omega,
            omega_dot,
            u,
            acceleration: link.inward(at, &carried),
        }
    }

    pub(super) fn wrench(&self, body: &MomentBody<S>, couple: MomentForm) -> Wrench<S> {
        let force = scaled(&body.mass, &self.acceleration);
        let force = sum(&force, &self.u_times(&body.first));
        let moment = self.couple(body, couple);
        let moment = sum(&moment, &cross(&body.first, &self.acceleration));
        Wrench { force, moment }
    }

    /// Returns ∫ r × (U r) dm
    fn couple(&self, body: &MomentBody<S>, form: MomentForm) -> Vector<S> {
        match form {
            MomentForm::SecondMoments => {
                let s = body.second.rows();
                let u = |row: usize, column: usize| &self.u[column][row];
                three(|i| {
                    let (j, k) = ((i + 1) % 3, (i + 2) % 3);
                    let squares = minus(&times(&s[j][j], u(k, j)), &times(&s[k][k], u(j, k)));
                    let within = plus(&squares, &times(&s[j][k], &minus(u(k, k), u(j, j))));
                    let mixed = minus(&times(&s[i][j], u(k, i)), &times(&s[i][k], u(j, i)));
                    plus(&within, &mixed)
                })
            }
            MomentForm::Euler => {
                let tensor = body.tensor();
                let turning = tensor_times(&tensor, &self.omega_dot);
                let spin = cross(&self.omega, &tensor_times(&tensor, &self.omega));
                sum(&turning, &spin)
            }
        }
    }
}

/// Returns ω̇ and U from ω̇_z, the third column of U and the products of ω, for which those of two
/// velocities do as well where U is to be bilinear in them.
pub(super) fn from_column<S: Scalar>(
    product: impl Fn(usize, usize) -> S,
    along: &S,
    column: Vector<S>,
) -> (Vector<S>, [Vector<S>; 3]) {
    let (xz, yz, xy) = (product(0, 2), product(1, 2), product(0, 1));
    let (xx, zz) = (product(0, 0), product(2, 2));
    let [x, y, z] = &column;
    // U_13 = ω_x ω_z + ω̇_y and U_23 = ω_y ω_z − ω̇_x.
    let omega_dot = [minus(&yz, y), minus(x, &xz), along.clone()];
    // U_33 = −(ω_x² + ω_y²), so −ω_y² = U_33 + ω_x².
    let minus_yy = plus(z, &xx);
    let u = [
        [
            minus(&minus_yy, &zz),
            plus(&xy, along),
            minus(&twice(&xz), x),
        ],
        [
            minus(&xy, along),
            negative(&plus(&xx, &zz)),
            minus(&twice(&yz), y),
        ],
        column,
    ];
    (omega_dot, u)
}

/// Returns U of ω̇ and of the products of ω, column by column; see [`from_column`].
pub(super) fn from_rates<S: Scalar>(
    product: impl Fn(usize, usize) -> S,
    omega_dot: &Vector<S>,
) -> [Vector<S>; 3] {
    let [dx, dy, dz] = omega_dot;
    let (xx, yy, zz) = (product(0, 0), product(1, 1), product(2, 2));
    let (xy, yz, xz) = (product(0, 1), product(1, 2), product(0, 2));
    [
        [negative(&plus(&yy, &zz)), plus(&xy, dz), minus(&xz, dy)],
        [minus(&xy, dz), negative(&plus(&xx, &zz)), plus(&yz, dx)],
        [plus(&xz, dy), minus(&yz, dx), negative(&plus(&xx, &yy))],
    ]
}

fn squares<S: Scalar>(omega: &Vector<S>) -> impl Fn(usize, usize) -> S + '_ {
    |i, j| times(&omega[i], &omega[j])
}

/// The motion of the base, and those of the links.
pub(super) struct Motions<S> {
    pub(super) base: LinkMotion<S>,
    pub(super) links: Vec<LinkMotion<S>>,
}

impl<S: Scalar> Chain<S> {
    /// Returns τ, an entry a coordinate: of a base that floats the wrench on it comes first.
    pub fn inverse_dynamics(
        &self,
        at: &Posture<S>,
        qd: &[S],
        qdd: &[S],
        spin: AccelerationForm,
        couple: MomentForm,
    ) -> Vec<S> {
        let motions = self.motions(at, qd, qdd, spin);
        let drive = |i: usize| self.drive(i, qd, qdd);
        self.torques(at, &motions, couple, &zero_vector(), drive)
    }

    /// The last link exerts a moment on something else; `drive` is added for each joint.
    pub(super) fn torques(
        &self,
        at: &Posture<S>,
        motions: &Motions<S>,
        couple: MomentForm,
        exerted: &Vector<S>,
        drive: impl Fn(usize) -> S,
    ) -> Vec<S> {
        let wrench = |i: usize| motions.links[i].wrench(&self.links[i].body, couple);
        let loads = self.loads(at, wrench, exerted, drive);
        self.with_base(loads, |body| motions.base.wrench(body, couple))
    }

    /// Returns the torques of each link's wrench, and the wrench that arrives at the base.
    pub(super) fn loads(
        &self,
        at: &Posture<S>,
        wrench: impl Fn(usize) -> Wrench<S>,
        exerted: &Vector<S>,
        drive: impl Fn(usize) -> S,
    ) -> (Vec<S>, Wrench<S>) {
        let last = self.links.len().checked_sub(1);
        let whole = |i: usize, outer: Option<Wrench<S>>| {
            let outer = outer.unwrap_or_else(|| match Some(i) == last {
                true => Wrench::couple(exerted.clone()),
                false => Wrench::zero(),
            });
            let felt = outer.with(&wrench(i));
            let torque = plus(&self.load(i, &felt), &drive(i));
            (felt, torque)
        };
        let back = |i: usize, felt: Wrench<S>| self.to_previous(i, at, &felt);
        let (torques, arrived) = self.inward(whole, back, Wrench::with);
        (torques, arrived.unwrap_or_else(Wrench::zero))
    }

    pub(super) fn motions(
        &self,
        at: &Posture<S>,
        qd: &[S],
        qdd: &[S],
        spin: AccelerationForm,
    ) -> Motions<S> {
        let (rates, accelerations) = (self.rates(qd), self.rates(qdd));
        let base = self.base_motion([qd, qdd], &self.gravity);
        let links = self.outward(base.clone(), |i, before: &LinkMotion<S>| {
            before.next(&self.links[i], &at[i], &rates[i], &accelerations[i], spin)
        });
        Motions { base, links }
    }

    pub(super) fn load(&self, i: usize, wrench: &Wrench<S>) -> S {
        let Wrench { force, moment } = wrench;
        match self.links[i].kind {
            JointKind::Revolute => moment[2].clone(),
            JointKind::Prismatic => times(&dot(force, &self.links[i].axis), &self.per_unit),
        }
    }

    pub(super) fn to_previous(&self, i: usize, at: &Posture<S>, wrench: &Wrench<S>) -> Wrench<S> {
        let (link, at) = (&self.links[i], &at[i]);
        wrench.carried(|v| link.outward(at, v), &link.lever(at))
    }
}

/// A motion with the accelerations a that make U_12 = ω_x ω_y − ω̇_z vanish: D (q̈ − a) = τ − τ(a).
pub(super) struct ReferenceMotion<S> {
    pub(super) accelerations: Vec<S>,
    pub(super) motions: Motions<S>,
}

impl<S: Divide> Chain<S> {
    /// a is zero of joints that slide, and of those that do not move.
    pub(super) fn reference_motion(
        &self,
        at: &Posture<S>,
        qd: &[S],
        moves: &[bool],
        spin: AccelerationForm,
    ) -> ReferenceMotion<S> {
        let (rates, moves) = (self.rates(qd), self.of_joints(moves));
        let mut accelerations = Vec::with_capacity(self.coordinates());
        let base = match self.base {
            None => self.base_motion([qd, qd], &self.gravity),
            Some(_) => {
                let (fall, base) = self.falling(qd);
                accelerations.extend(fall);
                base
            }
        };
        let links = self.outward(base.clone(), |i, before: &LinkMotion<S>| {
            let link = &self.links[i];
            match link.kind {
                JointKind::Revolute if moves[i] => {
                    let [x, y, _] = link.inward(&at[i], &before.omega);
                    let along = times(&x, &y);
                    let carried = dot(&link.axis_before(), &before.omega_dot);
                    accelerations.push(minus(&along, &carried));
                    before.next_along(link, &at[i], &rates[i], &along, spin)
                }
                _ => {
                    accelerations.push(S::zero());
                    before.next(link, &at[i], &rates[i], &S::zero(), spin)
                }
            }
        });
        ReferenceMotion {
            accelerations,
            motions: Motions { base, links },
        }
    }
}

impl<S: Scalar> Chain<S> {
    /// Returns loads with what rotors and friction take of each joint.
    pub fn driven(&self, mut loads: Vec<S>, qd: &[S], accelerations: &[S]) -> Vec<S> {
        for (joint, load) in loads.iter_mut().skip(self.base_coordinates()).enumerate() {
            *load = plus(load, &self.drive(joint, qd, accelerations));
        }
        loads
    }

    pub(crate) fn drive(&self, joint: usize, qd: &[S], accelerations: &[S]) -> S {
        let link = &self.links[joint];
        let [rate, acceleration] = [qd, accelerations].map(|values| &self.of_joints(values)[joint]);
        let inertial = times(&link.armature, acceleration);
        plus(&inertial, &link.friction.torque(rate))
    }
}
