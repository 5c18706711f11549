//! An acrobot, two links of which only the elbow has a motor, swings up and stays there.
//!
//! - [`model`]: a step of the arm and its slopes, by the generated derivatives
//! - [`plan`]: torques that swing it up, by differential dynamic programming
//! - [`follow`]: the plan on the arm, with its gains; then the upright pose is held
//!
//! The motor has 6 N·m, and nothing turns the shoulder but what the elbow does: the arm swings
//! one way, then the other, then up.
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

/// The most that the motor gives, N·m.
pub const LIMIT: f64 = 6.0;

/// Returns the torque as the motor gives it.
pub fn limited(torque: f64) -> f64 {
    torque.clamp(-LIMIT, LIMIT)
}
