//! The arguments of functions in the scalar of a computation.

use alloc::vec::Vec;

use super::Argument;
use crate::equations::JointPosition;
use crate::equations::following::Following;
use crate::equations::load::Loading;
use crate::scalar::Scalar;

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
    /// For each joint, true if it moves by itself; one that does not is held where it is,
    /// or follows another.
    pub moves: Vec<bool>,
    /// The payload at the hand, where that is an argument.
    pub loading: Option<Loading<S>>,
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

    /// Returns the entries of an argument; of the positions none, and of what is no
    /// joint vector.
    pub fn of_mut(&mut self, argument: Argument) -> Option<&mut Vec<S>> {
        match argument {
            Argument::Position
            | Argument::Wrench
            | Argument::Damping
            | Argument::Gravity
            | Argument::Load
            | Argument::Payload => None,
            Argument::Velocity => Some(&mut self.qd),
            Argument::Acceleration => Some(&mut self.qdd),
            Argument::Torque => Some(&mut self.tau),
            Argument::ReferenceVelocity => Some(&mut self.v),
            Argument::ReferenceAcceleration => Some(&mut self.a),
            Argument::Multiplier => Some(&mut self.multiplier),
        }
    }
}

impl<S: Clone> Motion<S> {
    /// Returns the motion of these joints alone.
    #[must_use]
    pub fn of_joints(&self, joints: &[usize]) -> Motion<S> {
        let pick = |values: &[S]| joints.iter().map(|&joint| values[joint].clone()).collect();
        Motion {
            q: joints.iter().map(|&joint| self.q[joint].clone()).collect(),
            qd: pick(&self.qd),
            qdd: pick(&self.qdd),
            tau: pick(&self.tau),
            v: pick(&self.v),
            a: pick(&self.a),
            wrench: self.wrench.clone(),
            damping: self.damping.clone(),
            multiplier: pick(&self.multiplier),
            per_speed: joints
                .iter()
                .map(|&joint| self.per_speed[joint].clone())
                .collect(),
            moves: joints.iter().map(|&joint| self.moves[joint]).collect(),
            loading: self.loading.clone(),
        }
    }
}

impl<S: Scalar> Motion<S> {
    /// Returns the motion of all rows of an arm from that of the joints that move by themselves:
    /// those that follow move with their leaders, and no torque is theirs.
    #[must_use]
    pub fn of_rows(self, following: &[Following<S>]) -> Motion<S> {
        if following.is_empty() {
            return self;
        }
        let mut motion = self;
        for own in following {
            // In their order, so that each stands at its own row at last.
            motion
                .q
                .insert(own.row, JointPosition::Prismatic(S::zero()));
            motion.moves.insert(own.row, false);
            motion.per_speed.insert(own.row, None);
            for argument in Argument::ALL {
                if let Some(entries) = motion.of_mut(argument) {
                    entries.insert(own.row, S::zero());
                }
            }
        }
        for own in following {
            motion.q[own.row] = motion.q[own.leader].followed_by(own);
            for argument in Argument::ALL {
                let Some(entries) = motion.of_mut(argument) else {
                    continue;
                };
                if argument != Argument::Torque {
                    entries[own.row] = own.motion(&entries[own.leader]);
                }
            }
        }
        motion
    }

    /// Returns the motion of an arm with one more link, that does not move.
    #[must_use]
    pub fn with_still_link(mut self) -> Motion<S> {
        self.q.push(JointPosition::Prismatic(S::zero()));
        self.moves.push(false);
        self.per_speed.push(None);
        for argument in Argument::ALL {
            if let Some(entries) = self.of_mut(argument) {
                entries.push(S::zero());
            }
        }
        self
    }
}
