//! The friction of a drive: the torque that it takes while its joint moves.
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
//! All but r_i is a polynomial. So r_i is an input of formulas, as sines and cosines are
//! ([`per_speed`]): what holds for any r_i holds for this one. Coulomb friction at a velocity is then
//! a damping, F_i r_i, beside b_i; its slope is F_i w_i² r_i³, written so everywhere:
//! F_i (r_i − q̇_i² r_i³) is the same number, and loses its digits to a difference at high speed.

use super::matrix::{negative, plus, times, twice};
use crate::scalar::{Divide, Scalar};

/// Friction of a joint, at the velocity that it has.
#[derive(Clone, Debug)]
pub struct Friction<S> {
    /// Viscous damping b_i.
    pub viscous: S,
    /// Coulomb friction, of a joint that has it.
    pub coulomb: Option<Coulomb<S>>,
}

/// Coulomb friction of a joint, at the velocity that it has.
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

/// Returns 1/√(q̇² + w²), from w². The sum is not zero, since w is not.
pub fn per_speed<S: Divide>(qd: &S, square_of_width: &S, sqrt: impl Fn(&S) -> S) -> S {
    S::one().div(&sqrt(&qd.mul(qd).add(square_of_width)))
}

impl<S: Scalar> Friction<S> {
    /// Returns the friction of a joint that moves freely.
    pub fn none() -> Friction<S> {
        let (viscous, coulomb) = (S::zero(), None);
        Friction { viscous, coulomb }
    }

    /// Returns b + F r: what the velocity is multiplied by.
    pub fn damping(&self) -> S {
        match &self.coulomb {
            None => self.viscous.clone(),
            Some(coulomb) => plus(&self.viscous, &coulomb.damping()),
        }
    }

    /// Returns (b + F r) q̇: what the drive takes at a velocity, N·m or N.
    pub fn torque(&self, qd: &S) -> S {
        times(&self.damping(), qd)
    }

    /// Returns ∂((b + F r) q̇)/∂q̇ = b + F r (w r)²: what that grows by with the velocity.
    pub fn slope(&self) -> S {
        match &self.coulomb {
            None => self.viscous.clone(),
            Some(coulomb) => plus(&self.viscous, &coulomb.slope()),
        }
    }

    /// Returns the growth of the slope: −3 q̇ r² times that of Coulomb friction, as r grows by −q̇ r³.
    pub fn curvature(&self, qd: &S) -> S {
        let Some(coulomb) = &self.coulomb else {
            return S::zero();
        };
        let square = times(&coulomb.per_speed, &coulomb.per_speed);
        let triple = plus(&twice(qd), qd);
        negative(&times(&times(&triple, &square), &coulomb.slope()))
    }
}

impl<S: Clone> Friction<S> {
    /// Takes this r of a velocity, if it is known, where there is Coulomb friction.
    pub fn take_speed(&mut self, per_speed: Option<&S>) {
        if let (Some(coulomb), Some(reciprocal)) = (&mut self.coulomb, per_speed) {
            coulomb.per_speed = reciprocal.clone();
        }
    }
}

impl<S: Divide> Friction<S> {
    /// Returns r at a velocity; `None` without Coulomb friction.
    pub fn per_speed(&self, qd: &S, sqrt: impl Fn(&S) -> S) -> Option<S> {
        let Coulomb { width, .. } = self.coulomb.as_ref()?;
        Some(per_speed(qd, &width.mul(width), sqrt))
    }
}

impl<S> Friction<S> {
    /// Returns every number through `f`.
    pub fn map<T>(&self, mut f: impl FnMut(&S) -> T) -> Friction<T> {
        Friction {
            viscous: f(&self.viscous),
            coulomb: self.coulomb.as_ref().map(|coulomb| Coulomb {
                force: f(&coulomb.force),
                width: f(&coulomb.width),
                per_speed: f(&coulomb.per_speed),
            }),
        }
    }
}

impl<S: Scalar> Coulomb<S> {
    /// Returns F r: the damping that it is at its velocity.
    fn damping(&self) -> S {
        times(&self.force, &self.per_speed)
    }

    /// Returns F r q̇, N·m or N.
    pub fn torque(&self, qd: &S) -> S {
        times(&self.damping(), qd)
    }

    /// Returns its growth with the velocity, F r (w r)².
    pub fn slope(&self) -> S {
        let part = times(&self.width, &self.per_speed);
        times(&self.damping(), &times(&part, &part))
    }
}
