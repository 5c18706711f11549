//! A Go2 stands on four feet and makes two steps, in simulation.
//!
//! - this file: the robot, its state, and the feet that stand on the ground
//! - [`balance`]: the controller, which shares the weight among the feet
//! - [`ground`]: the motion while feet stand, touch-down, and energy
//! - [`walk`]: both together, at 1 kHz
#![forbid(unsafe_code)]

pub mod balance;
pub mod ground;
pub mod walk;

use dalembert_pose::{Pose, Quaternion};
use nalgebra::{SMatrix, SVector};

dalembert::dynamics! {
    /// The robot, with what the ground does to its feet.
    pub mod go2 = "robots/go2.toml";
    outputs: inverse_dynamics, inertia, kinetic_energy, potential_energy,
        forward_kinematics@fl_foot, forward_kinematics@fr_foot,
        forward_kinematics@rl_foot, forward_kinematics@rr_foot,
        contact_jacobians@fl_foot, fr_foot, rl_foot, rr_foot,
        contact_bias@fl_foot, fr_foot, rl_foot, rr_foot,
        contact_forward_dynamics@fl_foot, fr_foot, rl_foot, rr_foot,
        contact_forward_dynamics@fr_foot, rl_foot, rr_foot,
        contact_forward_dynamics@fl_foot, rl_foot, rr_foot;
    scalar: f64;
}

/// A value for each velocity: six of the base, then one a joint.
pub type Rates = SVector<f64, { go2::NV }>;
/// Positions of the joints, rad.
pub type Joints = [f64; go2::N];
/// J of the four feet, three rows a foot.
pub type Jacobian = SMatrix<f64, 12, { go2::NV }>;

/// The legs in the order of joints and feet: FL, FR, RL, RR.
pub const LEGS: usize = 4;

/// Gravity in world axes, m/s².
pub const GRAVITY: [f64; 3] = [0.0, 0.0, -9.81];

/// The robot's motion.
#[derive(Clone, Copy, Debug)]
pub struct State {
    /// The pose of the base.
    pub pose: Pose<f64>,
    /// Positions of the joints, rad.
    pub q: Joints,
    /// Velocities: (v, ω) of the base in its axes, then the joints'.
    pub v: Rates,
}

/// The feet that stand on the ground.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stance {
    /// All four.
    Four,
    /// All but the front left one.
    RightThree,
    /// All but the front right one.
    LeftThree,
}

impl Stance {
    /// Returns true if the foot of a leg stands.
    pub fn has(self, leg: usize) -> bool {
        match self {
            Stance::Four => true,
            Stance::RightThree => leg != 0,
            Stance::LeftThree => leg != 1,
        }
    }
}

/// The joints of a leg that is bent: hip, thigh and knee, rad.
pub const BENT: [f64; 3] = [0.0, 0.8, -1.5];

impl State {
    /// Returns the robot at rest, level, with bent legs and its feet on the ground, z = 0.
    pub fn at_rest() -> State {
        let q = std::array::from_fn(|joint| BENT[joint % 3]);
        let mut state = State {
            pose: Pose {
                position: [0.0; 3],
                orientation: Quaternion::from_xyzw([0.0, 0.0, 0.0, 1.0]),
            },
            q,
            v: Rates::zeros(),
        };
        state.pose.position[2] = -state.height(0);
        state
    }

    /// Returns gravity in the base's axes, m/s².
    pub fn gravity(&self) -> go2::Gravity {
        go2::Gravity(self.pose.orientation.rotate_back(GRAVITY))
    }

    /// Returns the height of a foot above the ground, m.
    pub fn height(&self, leg: usize) -> f64 {
        self.foot(leg)[2]
    }

    /// Returns where a foot is in the world, m.
    pub fn foot(&self, leg: usize) -> [f64; 3] {
        let rows = match leg {
            0 => go2::forward_kinematics_fl_foot(&self.q),
            1 => go2::forward_kinematics_fr_foot(&self.q),
            2 => go2::forward_kinematics_rl_foot(&self.q),
            _ => go2::forward_kinematics_rr_foot(&self.q),
        };
        let foot = self.pose.orientation.rotate(rows.map(|[.., place]| place));
        std::array::from_fn(|i| self.pose.position[i] + foot[i])
    }

    /// Returns J of the four feet.
    pub fn jacobian(&self) -> Jacobian {
        let rows = go2::contact_jacobians_fl_foot_fr_foot_rl_foot_rr_foot(&self.q);
        Jacobian::from_fn(|row, column| rows[row][column])
    }

    /// Returns the kinetic and the potential energy, J; the second is zero where the base's origin
    /// and everything else are on the ground.
    pub fn energy(&self) -> f64 {
        let mass = go2::inertia(&self.q)[go2::BASE][go2::BASE];
        let kinetic = go2::kinetic_energy(&self.q, &self.v.into());
        let below = go2::potential_energy(&self.q, &self.gravity());
        kinetic + below - mass * GRAVITY[2] * self.pose.position[2]
    }
}
