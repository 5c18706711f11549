//! The customised Newton–Euler recursion.
//!
//! With U r = ω̇ × r + ω × (ω × r) the acceleration of a point r of a link is
//! v̇ + U r, so a regrouped link costs the few columns of U that its few
//! moments need.

use alloc::vec::Vec;

use super::{Body, Chain, ChainLink, Displacement};
use crate::equations::matrix::{
    Vector, cross, dot, minus, negative, opposite, plus, scaled, sum, times, twice, zero_vector,
};
use crate::robot::JointKind;
use crate::scalar::Scalar;

/// The motion of one link, in its own axes.
#[derive(Clone, Debug)]
pub(super) struct Motion<S> {
    pub(super) omega: Vector<S>,
    pub(super) omega_dot: Vector<S>,
    /// U, column by column.
    pub(super) u: [Vector<S>; 3],
    /// v̇ of the origin.
    pub(super) acceleration: Vector<S>,
}

impl<S: Scalar> Motion<S> {
    /// Returns the base, accelerated upwards instead of being pulled down.
    pub(super) fn base(gravity: &Vector<S>) -> Self {
        Motion {
            omega: zero_vector(),
            omega_dot: zero_vector(),
            u: [zero_vector(), zero_vector(), zero_vector()],
            acceleration: opposite(gravity),
        }
    }

    /// Returns U r
    pub(super) fn u_times(&self, r: &Vector<S>) -> Vector<S> {
        let xy = sum(&scaled(&r[0], &self.u[0]), &scaled(&r[1], &self.u[1]));
        sum(&xy, &scaled(&r[2], &self.u[2]))
    }

    /// Returns the motion of the next link.
    pub(super) fn next(
        &self,
        link: &ChainLink<S>,
        at: &Displacement<S>,
        rate: &S,
        acceleration: &S,
    ) -> Self {
        match link.kind {
            JointKind::Prismatic => {
                let carried = sum(&self.acceleration, &self.u_times(&link.lever(at)));
                let axis = &link.axis;
                let coriolis = cross(&scaled(&twice(rate), &self.omega), axis);
                Motion {
                    acceleration: sum(&sum(&carried, &coriolis), &scaled(acceleration, axis)),
                    ..self.clone()
                }
            }
            JointKind::Revolute => {
                let carried = dot(&link.axis_before(), &self.omega_dot);
                self.next_along(link, at, rate, &plus(&carried, acceleration))
            }
        }
    }

    /// Returns the motion of the next link, which turns, where ω̇ is this along its axis.
    pub(super) fn next_along(
        &self,
        link: &ChainLink<S>,
        at: &Displacement<S>,
        rate: &S,
        along: &S,
    ) -> Self {
        let carried = sum(&self.acceleration, &self.u_times(&link.lever(at)));
        let [x, y, z] = link.inward(at, &self.omega);
        let omega = [x, y, plus(&z, rate)];
        let column = link.inward(at, &self.u_times(&link.axis_before()));
        let product = |i: usize, j: usize| times(&omega[i], &omega[j]);
        let (omega_dot, u) = from_column(product, along, column);
        Motion {
            omega,
            omega_dot,
            u,
            acceleration: link.inward(at, &carried),
        }
    }

    /// Computes force and moment of a body in this motion.
    pub(super) fn wrench(&self, body: &Body<S>) -> (Vector<S>, Vector<S>) {
        let force = sum(
            &scaled(&body.mass, &self.acceleration),
            &self.u_times(&body.first),
        );
        let moment = sum(&self.couple(body), &cross(&body.first, &self.acceleration));
        (force, moment)
    }

    /// Returns ∫ r × (U r) dm, the antisymmetric part of U Σ.
    fn couple(&self, body: &Body<S>) -> Vector<S> {
        let sigma = &body.second;
        let u = |row: usize, column: usize| &self.u[column][row];
        let part = |a: &S, x: &S, b: &S, y: &S, c: &S, p: &S, q: &S| {
            let squares = minus(&times(a, x), &times(b, y));
            plus(&squares, &times(c, &minus(p, q)))
        };
        let mixed = |a: &S, x: &S, b: &S, y: &S| minus(&times(a, x), &times(b, y));
        let (xx, yy, zz) = (&sigma.xx, &sigma.yy, &sigma.zz);
        let (xy, yz, xz) = (&sigma.xy, &sigma.yz, &sigma.xz);
        [
            plus(
                &part(yy, u(2, 1), zz, u(1, 2), yz, u(2, 2), u(1, 1)),
                &mixed(xy, u(2, 0), xz, u(1, 0)),
            ),
            plus(
                &part(zz, u(0, 2), xx, u(2, 0), xz, u(0, 0), u(2, 2)),
                &mixed(yz, u(0, 1), xy, u(2, 1)),
            ),
            match u(2, 2).is_zero() {
                // It turns about z alone: U_12 = −U_21, and the others vanish.
                true => times(&plus(xx, yy), u(1, 0)),
                false => plus(
                    &part(xx, u(1, 0), yy, u(0, 1), xy, u(1, 1), u(0, 0)),
                    &mixed(xz, u(1, 2), yz, u(0, 2)),
                ),
            },
        ]
    }
}

/// Returns ω̇ and U from ω, ω̇_z and the third column of U, which is that of the link before,
/// turned: it does not depend on the joint's own motion.
///
/// Nothing of ω is needed but its products, so those of two velocities do as
/// well where U is to be bilinear in them.
pub(super) fn from_column<S: Scalar>(
    product: impl Fn(usize, usize) -> S,
    along: &S,
    column: Vector<S>,
) -> (Vector<S>, [Vector<S>; 3]) {
    let (xz, yz, xy) = (product(0, 2), product(1, 2), product(0, 1));
    let (xx, zz) = (product(0, 0), product(2, 2));
    // U_13 = ω_x ω_z + ω̇_y and U_23 = ω_y ω_z − ω̇_x.
    let omega_dot = [
        minus(&yz, &column[1]),
        minus(&column[0], &xz),
        along.clone(),
    ];
    // U_33 = −(ω_x² + ω_y²), so −ω_y² = U_33 + ω_x².
    let minus_yy = plus(&column[2], &xx);
    let u = [
        [
            minus(&minus_yy, &zz),
            plus(&xy, along),
            minus(&twice(&xz), &column[0]),
        ],
        [
            minus(&xy, along),
            negative(&plus(&xx, &zz)),
            minus(&twice(&yz), &column[1]),
        ],
        column,
    ];
    (omega_dot, u)
}

impl<S: Scalar> Chain<S> {
    /// Returns τ, length n.
    pub fn inverse_dynamics(&self, at: &[Displacement<S>], qd: &[S], qdd: &[S]) -> Vec<S> {
        let motions = self.motions(at, &self.gravity, [qd, qdd]);
        self.with_drives(&self.loads(at, &motions, &zero_vector()), [qd, qdd])
    }

    /// Returns the part of τ that links in motion take, with a moment that the last one exerts
    /// on something else.
    pub(super) fn loads(
        &self,
        at: &[Displacement<S>],
        motions: &[Motion<S>],
        exerted: &Vector<S>,
    ) -> Vec<S> {
        let mut loads = Vec::with_capacity(self.links.len());
        let (mut force, mut moment) = (zero_vector(), exerted.clone());
        for (i, motion) in motions.iter().enumerate().rev() {
            let (own, own_moment) = motion.wrench(&self.links[i].body);
            force = sum(&force, &own);
            moment = sum(&moment, &own_moment);
            loads.push(self.load(i, &force, &moment));
            (force, moment) = self.to_previous(i, &at[i], &force, &moment);
        }
        loads.reverse();
        loads
    }

    /// Returns the torque that the drive of a joint takes: its rotor's inertia and friction.
    pub(super) fn drive(&self, joint: usize, qd: &S, qdd: &S) -> S {
        let link = &self.links[joint];
        plus(&times(&link.armature, qdd), &link.friction.torque(qd))
    }

    /// Returns τ from the loads of the links.
    pub fn with_drives(&self, loads: &[S], [qd, qdd]: [&[S]; 2]) -> Vec<S> {
        let loads = loads.iter().enumerate();
        let torques = loads.map(|(i, load)| plus(load, &self.drive(i, &qd[i], &qdd[i])));
        torques.collect()
    }

    /// Returns the motion of every link under this gravity.
    pub(super) fn motions(
        &self,
        at: &[Displacement<S>],
        gravity: &Vector<S>,
        [qd, qdd]: [&[S]; 2],
    ) -> Vec<Motion<S>> {
        let (rates, accelerations) = (self.rates(qd), self.rates(qdd));
        let mut motions: Vec<Motion<S>> = Vec::with_capacity(self.links.len());
        let base = Motion::base(gravity);
        for (i, link) in self.links.iter().enumerate() {
            let before = motions.last().unwrap_or(&base);
            motions.push(before.next(link, &at[i], &rates[i], &accelerations[i]));
        }
        motions
    }

    /// Returns the part of a wrench on link i that the joint feels.
    pub(super) fn load(&self, i: usize, force: &Vector<S>, moment: &Vector<S>) -> S {
        match self.links[i].kind {
            JointKind::Revolute => moment[2].clone(),
            JointKind::Prismatic => times(&dot(force, &self.links[i].axis), &self.per_unit),
        }
    }

    /// Returns a wrench about the origin of frame i, about that of frame i−1.
    pub(super) fn to_previous(
        &self,
        i: usize,
        at: &Displacement<S>,
        force: &Vector<S>,
        moment: &Vector<S>,
    ) -> (Vector<S>, Vector<S>) {
        let link = &self.links[i];
        let force = link.outward(at, force);
        let moment = link.outward(at, moment);
        let moment = sum(&moment, &cross(&link.lever(at), &force));
        (force, moment)
    }
}
