//! The facts of a quantity, and the arguments of its formulas.

use alloc::vec::Vec;
use core::cell::OnceCell;

use super::Argument;
use super::operational::damped_mobility;
use super::quantity::Facts;
use crate::equations::chain::composite::Composite;
use crate::equations::chain::second_derivatives::SecondDerivatives;
use crate::equations::chain::{Chain, Form, Posture};
use crate::equations::factor::picked;
use crate::equations::following::{FollowerLine, gathered_square};
use crate::equations::load::LoadArguments;
use crate::equations::regressor::Column;
use crate::equations::{Arm, At, Formulation, JointPosition};
use crate::scalar::{Divide, Scalar};

/// A quantity: what it is, and its formulas, each over any scalar.
pub(super) trait Formula {
    const FACTS: Facts;

    /// Computes it by a textbook formulation: what everything else is proved against.
    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S>;

    /// Computes it by the chain formulas, if these give it; else a search starts as written.
    fn regrouped<S: Divide>(_: &Regrouped<'_, S>) -> Option<Vec<S>> {
        None
    }

    /// Returns the symmetric matrix that it inverts beside D, whose condition says how far rounding
    /// may move it: Λ⁻¹ + λ² 1 of what is damped.
    fn divisor<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        match Self::FACTS.arguments.contains(&Argument::Damping) {
            true => damped_mobility(at).concat(),
            false => Vec::new(),
        }
    }

    /// Returns residuals that vanish if these entries over all joints are the quantity's, by an
    /// equation that it solves; none where [`Formula::written`] defines it.
    fn residual<S: Divide>(_: &Written<'_, S>, _: &[S]) -> Vec<S> {
        Vec::new()
    }
}

/// The arguments in the scalar of a computation.
#[derive(Clone, Debug)]
pub struct Motion<S> {
    /// Positions.
    pub q: Vec<JointPosition<S>>,
    /// Velocities.
    pub qd: Vec<S>,
    /// Accelerations.
    pub qdd: Vec<S>,
    /// Torques.
    pub tau: Vec<S>,
    /// Velocities wished for.
    pub v: Vec<S>,
    /// Accelerations wished for.
    pub a: Vec<S>,
    /// Force over moment that act on the hand.
    pub wrench: Vec<S>,
    /// λ², one number.
    pub damping: Vec<S>,
    /// λ, by which torques or accelerations are multiplied before they are differentiated.
    pub multiplier: Vec<S>,
    /// r_i = 1/√(q̇_i² + w_i²) of each joint with Coulomb friction, where it is not
    /// that of a joint at rest ([`friction`](crate::equations::friction)).
    pub per_speed: Vec<Option<S>>,
    /// For each joint, true if it moves by itself; one that does not is held or follows another.
    pub moves: Vec<bool>,
    /// The parameters that are arguments, where some are.
    pub loading: Option<LoadArguments<S>>,
}

impl<S> Motion<S> {
    /// Makes the formula at these positions, with the entries of all other arguments.
    pub fn new(q: Vec<JointPosition<S>>, mut entries: impl FnMut(Argument) -> Vec<S>) -> Self {
        Motion {
            moves: alloc::vec![true; q.len()],
            per_speed: q.iter().map(|_| None).collect(),
            q,
            qd: entries(Argument::Velocity),
            qdd: entries(Argument::Acceleration),
            tau: entries(Argument::Torque),
            v: entries(Argument::ReferenceVelocity),
            a: entries(Argument::ReferenceAcceleration),
            wrench: entries(Argument::Wrench),
            damping: entries(Argument::Damping),
            multiplier: entries(Argument::Multiplier),
            loading: None,
        }
    }

    /// Returns the arguments that have an entry a joint, but for the positions.
    pub fn vectors_mut(&mut self) -> [(Argument, &mut Vec<S>); 6] {
        [
            (Argument::Velocity, &mut self.qd),
            (Argument::Acceleration, &mut self.qdd),
            (Argument::Torque, &mut self.tau),
            (Argument::ReferenceVelocity, &mut self.v),
            (Argument::ReferenceAcceleration, &mut self.a),
            (Argument::Multiplier, &mut self.multiplier),
        ]
    }
}

impl<S: Clone> Motion<S> {
    /// Returns the motion of these joints alone.
    #[must_use]
    pub fn of_joints(&self, joints: &[usize]) -> Motion<S> {
        let mut motion = self.clone();
        motion.q = picked(&self.q, joints);
        motion.per_speed = picked(&self.per_speed, joints);
        motion.moves = picked(&self.moves, joints);
        for (_, entries) in motion.vectors_mut() {
            *entries = picked(entries, joints);
        }
        motion
    }
}

impl<S: Scalar> Motion<S> {
    /// Returns the motion of all rows of an arm from that of the joints that move by themselves:
    /// those that follow move with their leaders, and no torque is theirs.
    #[must_use]
    pub fn of_rows(mut self, following: &[FollowerLine<S>]) -> Motion<S> {
        for line in following {
            // In their order, so that each stands at its own row at last.
            self.insert_still(line.row);
        }
        for line in following {
            self.q[line.row] = self.q[line.leader].followed_by(line);
            for (argument, entries) in self.vectors_mut() {
                if argument != Argument::Torque {
                    entries[line.row] = line.motion(&entries[line.leader]);
                }
            }
        }
        self
    }

    /// Returns the motion of an arm with one more link, that does not move.
    #[must_use]
    pub fn with_still_link(mut self) -> Motion<S> {
        self.insert_still(self.q.len());
        self
    }

    fn insert_still(&mut self, row: usize) {
        self.q.insert(row, JointPosition::Prismatic(S::zero()));
        self.moves.insert(row, false);
        self.per_speed.insert(row, None);
        for (_, entries) in self.vectors_mut() {
            entries.insert(row, S::zero());
        }
    }
}

/// An arm in motion, and the formulation that is asked.
#[derive(Clone, Copy, Debug)]
pub struct Written<'a, S> {
    /// The textbook's formulation.
    pub formulation: Formulation,
    /// The arm.
    pub arm: &'a Arm<S>,
    /// The position.
    pub at: &'a At<S>,
    /// The motion of the arm.
    pub motion: &'a Motion<S>,
    /// The columns of a regressor; none where nothing asked is one.
    pub columns: &'a [Column<S>],
}

/// A chain in motion, and how its formulas are associated.
#[derive(Clone, Debug)]
pub struct Regrouped<'a, S> {
    /// The chain at its position.
    pub chain: &'a Chain<S>,
    /// The positions of its joints.
    pub at: &'a Posture<S>,
    /// Its composite bodies.
    pub composite: Composite<'a, S>,
    /// The motion of its joints.
    pub motion: &'a Motion<S>,
    /// The association.
    pub form: Form,
    /// The whole arm in motion, where something asked is of a frame: the chain has none.
    pub textbook: Option<Written<'a, S>>,
    /// The joints of the chain among those of the arm.
    pub joints: &'a [usize],
    /// Those of the chain that follow others, by their places in it.
    pub following: &'a [FollowerLine<S>],
    /// The second derivatives of λᵀτ and those of λᵀq̈, computed where they are first asked for.
    pub shared: [OnceCell<SecondDerivatives<S>>; 2],
}

impl<S: Scalar> Regrouped<'_, S> {
    pub(super) fn gathered_inertia(&self) -> Vec<Vec<S>> {
        gathered_square(self.following, self.composite.inertia(self.form.travel))
    }

    pub(super) fn pick(&self, values: &[S]) -> Vec<S> {
        picked(values, self.joints)
    }
}
