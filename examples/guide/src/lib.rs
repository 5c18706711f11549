//! The code of the guide in `docs/`, where every block of Rust is a piece of this crate.
//!
//! - [`hold`]: holds the arm against gravity, with a tool; finds a payload from torques
//! - [`simulate`]: moves the arm under torques
//! - [`control`]: a controller that follows a motion
#![forbid(unsafe_code)]

pub mod control;
pub mod hold;
pub mod simulate;

dalembert::dynamics! {
    /// The arm of the guide.
    pub mod arm = "robots/arm.toml";
    outputs: inverse_dynamics, gravity, forward_dynamics;
    scalar: f64;
}

dalembert::dynamics! {
    /// The arm with a kilogram in its hand.
    pub mod with_a_kilogram = "robots/arm.toml";
    scene: kilo;
    scalar: f64;
}

dalembert::dynamics! {
    /// The arm with payload and gravity as arguments.
    pub mod carrying = "robots/arm.toml";
    outputs: inverse_dynamics, gravity;
    scalar: f64;
    parameters: payload, gravity;
}

dalembert::dynamics! {
    /// This arm with the bodies of its links as arguments.
    pub mod varied = "robots/arm.toml";
    outputs: inverse_dynamics;
    scalar: f64;
    parameters: bodies;
}

dalembert::dynamics! {
    /// The arm while it picks: two torques, within 1% of the actuators' limits.
    pub mod picking = "robots/arm.toml";
    scene: pick;
    scalar: f64;
}

/// A value for each joint.
pub type Joints = [f64; arm::N];
