//! Holding the arm against gravity.

use crate::{Joints, arm};

/// How much of a turn too far is pulled back, N·m/rad, and what it damps, N·m s/rad.
const STIFFNESS: f64 = 80.0;
const DAMPING: f64 = 6.0;

/// Returns the torques that let the arm float: it stays where a hand puts it.
pub fn float(q: &Joints) -> Joints {
    arm::gravity(q)
}

/// Returns the torques that bring it back to a pose, softly.
pub fn hold(q: &Joints, qd: &Joints, pose: &Joints) -> Joints {
    let load = arm::gravity(q);
    std::array::from_fn(|i| load[i] + STIFFNESS * (pose[i] - q[i]) - DAMPING * qd[i])
}
