//! The recursive Newton–Euler forms: motion outward from the base, forces inward from the hand.
//!
//! - [`table1`]: every vector in base axes (Table 1)
//! - [`table2`]: every vector in the axes of its own link (Table 2)
//!
//! Gravity enters as the upward acceleration of the base, v̇_0 = −g.

pub mod table1;
pub mod table2;

use super::Link;
use super::matrix::{Vector, centripetal, cross, opposite, plus, sum, times, zero_vector};
use crate::scalar::Scalar;

#[derive(Clone, Debug)]
pub(super) struct FrameMotion<S> {
    omega: Vector<S>,
    omega_dot: Vector<S>,
    /// v̇ of the origin of frame i.
    acceleration: Vector<S>,
}

impl<S: Scalar> FrameMotion<S> {
    fn new(omega: Vector<S>, omega_dot: Vector<S>, acceleration: Vector<S>) -> Self {
        FrameMotion {
            omega,
            omega_dot,
            acceleration,
        }
    }

    /// Returns the base, accelerated upwards instead of being pulled down.
    pub(super) fn of_base(gravity: &Vector<S>) -> Self {
        FrameMotion::new(zero_vector(), zero_vector(), opposite(gravity))
    }

    /// Returns ω̇ × r + ω × (ω × r).
    fn of_lever(&self, r: &Vector<S>) -> Vector<S> {
        let turning = cross(&self.omega_dot, r);
        sum(&turning, &centripetal(&self.omega, r))
    }

    fn acceleration_at(&self, r: &Vector<S>) -> Vector<S> {
        sum(&self.acceleration, &self.of_lever(r))
    }
}

fn with_drive<S: Scalar>(link: &Link<S>, torque: &S, qd: &S, qdd: &S) -> S {
    let damped = plus(torque, &link.friction.torque(qd));
    plus(&damped, &times(&link.armature, qdd))
}
