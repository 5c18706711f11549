//! What a drive takes of torque while its joint moves.
//!
//! ```text
//! τ_i ∋ b_i q̇_i + F_i q̇_i r_i,   r_i = 1/√(q̇_i² + w_i²)
//! ```
//!
//! Coulomb friction has a force F_i against the motion, whatever its speed. At
//! q̇_i = 0 its sign would jump; over a width w_i it is smoothed instead, so that
//! q̇ = 0 is a state like others and derivatives exist everywhere. At a speed of
//! w_i the friction is F_i/√2, at 10 w_i less than 0.5 % below F_i.
//!
//! All but r_i is a polynomial. So r_i is an input of formulas, as sines and
//! cosines are: whoever knows q̇ computes it ([`per_speed`]), and what holds for
//! any r_i holds for this one. Coulomb friction at a velocity is then a damping,
//! F_i r_i, beside b_i; its slope is ∂(F_i q̇_i r_i)/∂q̇_i = F_i w_i² r_i³, which is
//! written so everywhere: F_i (r_i − q̇_i² r_i³) is the same number, but another
//! polynomial, and loses its digits to a difference at high speed.

use super::matrix::{plus, times};
use crate::scalar::{Divide, Scalar};

/// Coulomb friction of a joint at the velocity that it has.
#[derive(Clone, Debug)]
pub struct Coulomb<S> {
    /// F_i, N·m or N.
    pub force: S,
    /// w_i, rad/s or m/s: over which speeds the sign is smoothed.
    pub width: S,
    /// r_i = 1/√(q̇_i² + w_i²); that of a joint at rest until something is said
    /// of its velocity ([`Arm::at_speeds`](super::Arm::at_speeds)).
    pub per_speed: S,
}

/// 1/√(q̇² + w²), from w². The sum is not zero, since w is not.
pub fn per_speed<S: Divide>(qd: &S, square_of_width: &S, sqrt: impl Fn(&S) -> S) -> S {
    S::one().div(&sqrt(&qd.mul(qd).add(square_of_width)))
}

/// b + F r: what the velocity is multiplied by.
pub(super) fn damping<S: Scalar>(viscous: &S, coulomb: Option<&Coulomb<S>>) -> S {
    match coulomb {
        None => viscous.clone(),
        Some(Coulomb {
            force, per_speed, ..
        }) => plus(viscous, &times(force, per_speed)),
    }
}

/// ∂((b + F r) q̇)/∂q̇ = b + F r (w r)².
pub(super) fn damping_slope<S: Scalar>(viscous: &S, coulomb: Option<&Coulomb<S>>) -> S {
    match coulomb {
        None => viscous.clone(),
        Some(coulomb) => plus(viscous, &coulomb.slope()),
    }
}

impl<S: Scalar> Coulomb<S> {
    /// F r q̇, N·m or N.
    pub fn torque(&self, qd: &S) -> S {
        times(&times(&self.force, &self.per_speed), qd)
    }

    /// What it grows by with the velocity, F r (w r)².
    pub fn slope(&self) -> S {
        let part = times(&self.width, &self.per_speed);
        times(&times(&self.force, &self.per_speed), &times(&part, &part))
    }
}

impl<S> Coulomb<S> {
    /// Every number through `f`.
    pub fn map<T>(&self, mut f: impl FnMut(&S) -> T) -> Coulomb<T> {
        Coulomb {
            force: f(&self.force),
            width: f(&self.width),
            per_speed: f(&self.per_speed),
        }
    }
}

/// Gives frictions the r of the velocities that joints have, where one is given.
pub(super) fn at_speeds<'a, S: Clone + 'a>(
    frictions: impl Iterator<Item = &'a mut Option<Coulomb<S>>>,
    per_speed: &[Option<S>],
) {
    for (friction, given) in frictions.zip(per_speed) {
        if let (Some(friction), Some(given)) = (friction, given) {
            friction.per_speed = given.clone();
        }
    }
}
