//! The dynamics formulas, each written once, generic over the [`Scalar`].
//!
//! [`Scalar`]: crate::scalar::Scalar

use alloc::vec::Vec;

use crate::robot::{Convention, Inertia, JointKind};
use crate::scalar::Scalar;

/// Sine and cosine of one angle.
#[derive(Clone, Debug)]
pub struct Rotor<S> {
    /// sin
    pub sin: S,
    /// cos
    pub cos: S,
}

/// The parameters of an arm in the scalar of a computation.
#[derive(Clone, Debug)]
pub struct Arm<S> {
    /// DH convention of every row.
    pub convention: Convention,
    /// Acceleration of gravity in base axes.
    pub gravity: [S; 3],
    /// Links from the base to the hand.
    pub links: Vec<Link<S>>,
}

/// One row of the table: see [`crate::robot::Joint`] for shapes and units.
#[derive(Clone, Debug)]
pub struct Link<S> {
    /// Revolute or prismatic.
    pub kind: JointKind,
    /// Twist α_i.
    pub alpha: Rotor<S>,
    /// Constant part of θ_i.
    pub theta: Rotor<S>,
    /// Length a_i.
    pub a: S,
    /// Constant part of d_i.
    pub d: S,
    /// Mass.
    pub mass: S,
    /// Centre of mass, link frame.
    pub com: [S; 3],
    /// About the centre of mass, link axes.
    pub inertia: Inertia<S>,
    /// Viscous damping b_i.
    pub viscous: S,
    /// Rotor inertia felt at the joint.
    pub armature: S,
}

/// A joint's position as the equations take it.
#[derive(Clone, Debug)]
pub enum JointPosition<S> {
    /// (sin q_i, cos q_i)
    Revolute(Rotor<S>),
    /// q_i
    Prismatic(S),
}

/// θ_i as a pair and d_i of one row, offsets applied.
#[derive(Clone, Debug)]
pub struct DhVariables<S> {
    /// θ_i
    pub theta: Rotor<S>,
    /// d_i
    pub d: S,
}

impl<S: Scalar> Rotor<S> {
    /// The pair of the sum of two angles.
    pub fn compose(&self, other: &Self) -> Self {
        Rotor {
            sin: self.sin.mul(&other.cos).add(&self.cos.mul(&other.sin)),
            cos: self.cos.mul(&other.cos).sub(&self.sin.mul(&other.sin)),
        }
    }
}

impl<S: Scalar> Arm<S> {
    /// θ_i and d_i of every row at a position.
    ///
    /// The offset enters as a product of pairs, never as a sum of angles:
    /// q + offset would lose |q|·u, or |offset|·u, of the angle.
    pub fn at(&self, position: &[JointPosition<S>]) -> Vec<DhVariables<S>> {
        self.links
            .iter()
            .zip(position)
            .map(|(link, q)| match q {
                JointPosition::Revolute(pair) => DhVariables {
                    theta: pair.compose(&link.theta),
                    d: link.d.clone(),
                },
                JointPosition::Prismatic(q) => DhVariables {
                    theta: link.theta.clone(),
                    d: q.add(&link.d),
                },
            })
            .collect()
    }
}
