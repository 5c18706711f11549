//! What a quantity's file says, and what its formulas are given.

use alloc::vec::Vec;

use super::quantity::Facts;
use crate::equations::chain::composite::Composite;
use crate::equations::chain::{Chain, Displacement, Form};
use crate::equations::{Arm, DhVariables, Formulation, JointPosition};
use crate::reference::{Float, JointVectors, Reference, WrongLength};
use crate::scalar::Scalar;

/// A quantity: what it is, and its formulas, each over any scalar.
pub(super) trait Formula {
    /// What it is.
    const FACTS: Facts;

    /// By a textbook formulation: what everything else is proved against.
    fn written<S: Scalar>(at: &Written<'_, S>) -> Vec<S>;

    /// By the chain formulas with regrouped parameters; `None` if these do not
    /// give it: then [`Formula::written`] is where a search starts.
    fn regrouped<S: Scalar>(_: &Regrouped<'_, S>) -> Option<Vec<S>> {
        None
    }

    /// By the generic runtime.
    fn runtime<T: Float>(
        runtime: &Reference<T>,
        at: &JointVectors<T>,
    ) -> Result<Vec<T>, WrongLength>;
}

/// q, q̇ and q̈ in the scalar of a computation.
#[derive(Clone, Debug)]
pub struct Motion<S> {
    /// Positions.
    pub q: Vec<JointPosition<S>>,
    /// Velocities.
    pub qd: Vec<S>,
    /// Accelerations.
    pub qdd: Vec<S>,
}

impl<S: Clone> Motion<S> {
    /// The motion of these joints alone.
    #[must_use]
    pub fn of_joints(&self, joints: &[usize]) -> Motion<S> {
        let pick = |values: &[S]| joints.iter().map(|&joint| values[joint].clone()).collect();
        Motion {
            q: joints.iter().map(|&joint| self.q[joint].clone()).collect(),
            qd: pick(&self.qd),
            qdd: pick(&self.qdd),
        }
    }
}

/// An arm in motion, and the formulation that is asked.
#[derive(Clone, Copy, Debug)]
pub struct Written<'a, S> {
    /// Which of the textbook's.
    pub formulation: Formulation,
    /// The arm.
    pub arm: &'a Arm<S>,
    /// Where it is.
    pub at: &'a [DhVariables<S>],
    /// How it moves.
    pub motion: &'a Motion<S>,
}

/// A chain in motion, and how its formulas are associated.
#[derive(Clone, Debug)]
pub struct Regrouped<'a, S> {
    /// The chain at its position.
    pub chain: &'a Chain<S>,
    /// Where its joints are.
    pub at: &'a [Displacement<S>],
    /// Its composite bodies.
    pub composite: Composite<'a, S>,
    /// How its joints move.
    pub motion: &'a Motion<S>,
    /// The association.
    pub form: Form,
}
