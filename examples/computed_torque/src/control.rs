//! The controllers; both use the generated model and nothing else.

use crate::plant::State;
use crate::trajectory::Target;
use crate::{Joints, puma560};

/// The closed loop's frequency, rad/s: each joint follows its target as a
/// critically damped second-order system.
const FREQUENCY: f64 = 20.0;
/// τ = c(q) + D(q)(ω² e − 2ω q̇): gravity is compensated, and springs and
/// dampers hold the pose.
///
/// They act through D, since what holds the shoulder is far too stiff for the
/// hand at 1 kHz.
pub fn hold(state: &State, pose: &Joints) -> Joints {
    let acceleration = core::array::from_fn(|i| {
        FREQUENCY * FREQUENCY * (pose[i] - state.q[i]) - 2.0 * FREQUENCY * state.qd[i]
    });
    puma560::inverse_dynamics(&state.q, &[0.0; puma560::N], &acceleration)
}

/// τ = D(q)(q̈_d + 2ω ė + ω² e) + h(q, q̇) + c(q), which is the inverse
/// dynamics at a corrected acceleration.
pub fn computed_torque(state: &State, target: &Target) -> Joints {
    let acceleration = core::array::from_fn(|i| {
        let (error, rate) = (target.q[i] - state.q[i], target.qd[i] - state.qd[i]);
        target.qdd[i] + 2.0 * FREQUENCY * rate + FREQUENCY * FREQUENCY * error
    });
    puma560::inverse_dynamics(&state.q, &state.qd, &acceleration)
}
