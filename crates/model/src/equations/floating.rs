//! A base that floats, as six joints of an arm: slides along x, y and z, then turns about x, y and
//! z, on links without mass but for the last, all at position zero.
//!
//! Coordinates of a floating robot's velocities are (v, ω) of the base in its axes, at its origin,
//! then those of the joints. With q̇ the rates of the six joints they are E q̇, where E is one at
//! position zero, so that accelerations differ by Ė q̇ alone:
//!
//! ```text
//! q̈ = (v̇, ω̇) − Ė q̇,    −Ė(q̇) w = (ω × w_v, (−ω_z w_y, ω_z w_x, −ω_y w_x))
//! C = C_q − D Ė
//! ```
//!
//! where C_q is of the Christoffel symbols in the six joints. C does not depend on how an
//! orientation is written: it is that of the symbols in any coordinates, C(q̇) q̇ = h, Ḋ − 2C is
//! skew, and C(v) w − C(w) v = D [v, w], where [v, w] = (ω × w_v − w_ω × v, ω × w_ω) of the base.
//!
//! Position zero is no loss: where the base is has no effect, and how it is turned none but on the
//! components of gravity in its axes.

use alloc::borrow::Cow;
use alloc::vec::Vec;

use super::arm::Posed;
use super::energy::moving;
use super::matrix::*;
use super::{Arm, At, JointPosition, Link, SinCosPair};
use crate::robot::JointKind::{Prismatic, Revolute};
use crate::scalar::Scalar;
use crate::scalar::dual::Dual;

/// The coordinates of a base's velocity: linear over angular.
pub const BASE_COORDINATES: usize = 6;

impl<S: Scalar> Link<S> {
    /// Returns the links of the six joints that a floating base is, of which the last is its body.
    pub fn of_base(body: Link<S>) -> Vec<Link<S>> {
        // z of each frame is x of the one before: after three turns the axes are as they were.
        let next = Columns::turned(three(|i| identity()[(i + 1) % 3].clone()));
        let joint = |k: usize| {
            let row = if k < 5 { Link::still() } else { body.clone() };
            let kind = if k < 3 { Prismatic } else { Revolute };
            let place = Some(next.clone());
            Link { kind, place, ..row }
        };
        (0..BASE_COORDINATES).map(joint).collect()
    }
}

impl<S> Arm<S> {
    /// Returns how many of its joints are those of a base that floats: six, or none.
    pub fn base_joints(&self) -> usize {
        if self.floats { BASE_COORDINATES } else { 0 }
    }

    /// Returns the first link that is a body: the base, where that floats.
    pub fn first_body(&self) -> usize {
        self.base_joints().saturating_sub(1)
    }
}

/// Returns the positions of the six joints that a floating base is.
pub fn base_position<S: Scalar>() -> [JointPosition<S>; BASE_COORDINATES] {
    core::array::from_fn(|k| match k < 3 {
        true => JointPosition::Prismatic(S::zero()),
        false => JointPosition::Revolute(SinCosPair::straight()),
    })
}

impl<S: Scalar> Arm<S> {
    /// Returns −Ė(q̇) w, zero of joints.
    pub(super) fn drift(&self, qd: &[S], w: &[S]) -> Vec<S> {
        let mut drift = zeros(qd.len());
        if self.floats {
            let ([_, omega], [linear, angular]) = (parts(qd), parts(w));
            let ([_, y, z], [along_x, along_y, _]) = (&omega, &angular);
            let turning = [
                negative(&times(z, along_y)),
                times(z, along_x),
                negative(&times(y, along_x)),
            ];
            let both = cross(&omega, &linear).into_iter().chain(turning);
            drift.splice(..BASE_COORDINATES, both);
        }
        drift
    }

    /// Returns q̈ of all joints, from the rates of their velocities' coordinates.
    pub(super) fn accelerations<'a>(&self, qd: &[S], rates: &'a [S]) -> Cow<'a, [S]> {
        match self.floats {
            false => Cow::Borrowed(rates),
            true => Cow::Owned(sums(rates, &self.drift(qd, qd))),
        }
    }

    /// Returns the rates of the velocities' coordinates, from q̈ of all joints.
    pub(super) fn coordinate_rates(&self, qd: &[S], qdd: Vec<S>) -> Vec<S> {
        match self.floats {
            false => qdd,
            true => differences(&qdd, &self.drift(qd, qd)),
        }
    }

    /// Returns a + [v, w] / 2
    pub(super) fn with_half_bracket<'a>(&self, a: &'a [S], [v, w]: [&[S]; 2]) -> Cow<'a, [S]> {
        if !self.floats {
            return Cow::Borrowed(a);
        }
        let bracket = differences(&self.drift(v, w), &self.drift(w, v));
        Cow::Owned(sums(a, &bracket.iter().map(halved).collect::<Vec<S>>()))
    }

    /// Returns −D Ė(q̇)
    pub(super) fn of_drift(&self, d: &[Vec<S>], qd: &[S]) -> Matrix<S> {
        self.of_base(d, |e| self.drift(qd, e))
    }

    /// Returns D times the slopes of −Ė(q̇) q̇ by q̇.
    pub(super) fn of_drift_slopes(&self, d: &[Vec<S>], qd: &[S]) -> Matrix<S> {
        self.of_base(d, |e| sums(&self.drift(qd, e), &self.drift(e, qd)))
    }

    fn of_base(&self, d: &[Vec<S>], column: impl Fn(&[S]) -> Vec<S>) -> Matrix<S> {
        let n = d.len();
        let columns = (0..n).map(|k| match k < self.base_joints() {
            true => products(d, &column(&unit(n, k))),
            false => zeros(n),
        });
        columns_of(&columns.collect::<Vec<_>>())
    }

    /// Returns the arm as one coordinate of its position grows at a unit rate, velocities kept: a
    /// base that floats moves in its axes, which turns gravity the other way.
    pub(super) fn displaced(&self, at: &At<S>, coordinate: usize) -> Posed<Dual<S>> {
        let n = at.len();
        if coordinate >= self.base_joints() {
            return moving(self, at, &unit(n, coordinate));
        }
        let (mut arm, at) = moving(self, at, &zeros(n));
        if let Some(axis) = coordinate.checked_sub(3) {
            let turn = three(|i| if i == axis { S::one() } else { S::zero() });
            for (component, rate) in arm.gravity.iter_mut().zip(cross(&self.gravity, &turn)) {
                component.rate = rate;
            }
        }
        (arm, at)
    }

    /// Returns the arm as its joints move at these velocities, seen from the base.
    pub(super) fn bending(&self, at: &At<S>, qd: &[S]) -> Posed<Dual<S>> {
        let mut joints = qd.to_vec();
        joints[..self.base_joints()].fill(S::zero());
        moving(self, at, &joints)
    }
}
