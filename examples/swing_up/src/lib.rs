//! An acrobot (two links with a motor at the elbow only) swings up and stays upright.
//!
//! - [`model`]: a time step of the arm and its derivatives, from generated code
//! - [`plan`]: torques that swing it up, by differential dynamic programming
//! - [`follow`]: runs the plan and its gains on the arm, then holds the arm upright
//!
//! The motor gives up to 6 N·m, and the shoulder has no motor: the arm swings one way, then the
//! other, then up.
#![forbid(unsafe_code)]

pub mod follow;
pub mod model;
pub mod plan;

dalembert::dynamics! {
    /// Two equal links in a vertical plane.
    pub mod planar2r = "../../generated/robots/planar2r.toml";
    outputs: forward_dynamics, forward_dynamics_derivatives, forward_dynamics_second_derivatives;
    scalar: f64;
}

/// The largest torque of the motor, N·m.
pub const LIMIT: f64 = 6.0;

/// Returns a torque clamped to the motor's limit.
pub fn limited(torque: f64) -> f64 {
    torque.clamp(-LIMIT, LIMIT)
}
