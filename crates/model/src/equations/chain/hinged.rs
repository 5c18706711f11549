//! Articulated bodies that only turn, about a point that stays where it is: what the joints of a
//! shoulder feel of all that is beyond them, I ω̇ + p.
//!
//! A joint about z that is given the torque τ turns with ω̇_z = w_z + q̈, w being what the
//! joints before bring along, so that D q̈ = τ − p_z − (I w)_z with D = I_zz + A, A its rotor.
//! What the joints before feel is I′ w + p′ with I′ = I − I_z I_zᵀ/D and p′ = p + I_z (τ − p_z)/D.

use super::body::entry;
use super::{Body, ChainLink, Displacement};
use crate::equations::matrix::{Vector, cross, minus, over, plus, sum, times};
use crate::equations::screws::Wrench;
use crate::robot::Inertia;
use crate::scalar::{Divide, Scalar};

/// A moment I ω̇ + p about the point, in the axes of a frame.
pub(super) struct Hinged<S> {
    pub(super) inertia: Inertia<S>,
    pub(super) moment: Vector<S>,
}

pub(super) struct Solved<S> {
    /// (τ − p_z) / D
    pub(super) own: S,
    /// I_xz / D, I_yz / D, I_zz / D
    pub(super) shares: Vector<S>,
}

impl<S: Scalar> Hinged<S> {
    pub(super) fn carried(&self, link: &ChainLink<S>, at: &Displacement<S>) -> Self {
        // A tensor turns as second moments do.
        let body = Body {
            second: self.inertia.clone(),
            ..Body::zero()
        };
        let inertia = match at {
            Displacement::Turn(theta) => body.turned_z(theta).turned(&link.rotation).second,
            Displacement::Slide(_) => body.second,
        };
        Hinged {
            inertia,
            moment: link.outward(at, &self.moment),
        }
    }

    pub(super) fn with(&self, body: &Body<S>, height: &S, wrench: &Wrench<S>) -> Self {
        let lever = [S::zero(), S::zero(), height.clone()];
        let own = body.moved(&lever).tensor();
        Hinged {
            inertia: Inertia::symmetric(|i, k| plus(entry(&self.inertia, i, k), entry(&own, i, k))),
            moment: sum(
                &self.moment,
                &sum(&wrench.moment, &cross(&lever, &wrench.force)),
            ),
        }
    }
}

impl<S: Divide> Hinged<S> {
    /// Eliminates a joint about z with this rotor, that is given this torque; of the first that
    /// moves nothing else is divided.
    pub(super) fn eliminated(self, rotor: &S, given: &S, is_first: bool) -> (Self, Solved<S>) {
        let Hinged { inertia, moment } = self;
        let pivot = plus(&inertia.zz, rotor);
        let inverse = over(&S::one(), &pivot);
        let left = minus(given, &moment[2]);
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
                true => given.clone(),
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
        let own = match is_first {
            true => over(&left, &pivot),
            false => times(&left, &inverse),
        };
        let shares = [x, y, z];
        (Hinged { inertia, moment }, Solved { own, shares })
    }
}
