//! A PUMA 560 held on a trajectory by its inverse dynamics.
//!
//! - [`control`]: gravity compensation and computed torque, from the model
//! - [`plant`]: the arm that is moved, with or without a payload
//! - [`trajectory`]: where it should be
//! - [`simulate`]: the three together, at 1 kHz
//!
//! The controller knows the arm without payload. Its tracking error is tiny
//! if that is the arm, and not if the hand holds as little as 50 g: so the
//! check of the error can fail.

pub mod control;
pub mod plant;
pub mod trajectory;

use plant::{Plant, State};

dalembert::dynamics! {
    /// The arm as the controller knows it.
    // Its table leaves out moments that no torque depends on, which warns.
    #[allow(deprecated)]
    pub mod puma560 = "../../generated/robots/puma560.toml";
    outputs: inverse_dynamics, manipulator_equation;
    scalar: f64;
}

dalembert::dynamics! {
    /// The arm with a payload in its hand.
    // Its table leaves out moments that no torque depends on, which warns.
    #[allow(deprecated)]
    pub mod loaded = "robots/loaded.toml";
    outputs: manipulator_equation;
    scalar: f64;
}

/// A value for each joint.
pub type Joints = [f64; puma560::N];

/// The period of the controller, s.
pub const PERIOD: f64 = 1e-3;

/// How far the arm was from where it should be.
#[derive(Clone, Copy, Debug)]
pub struct Errors {
    /// Largest distance of a joint while gravity compensation held it, rad.
    pub holding: f64,
    /// Largest distance of a joint while it followed the trajectory, rad.
    pub tracking: f64,
}

/// Holds the arm for `hold` seconds, then moves it for `motion` seconds.
pub fn simulate(plant: Plant, hold: f64, motion: f64) -> Errors {
    let start = trajectory::at(0.0);
    let mut state = State {
        q: start.q,
        qd: [0.0; puma560::N],
    };
    let mut errors = Errors {
        holding: 0.0,
        tracking: 0.0,
    };
    for _ in 0..steps(hold) {
        let tau = control::hold(&state, &start.q);
        state = plant.step(&state, &tau, PERIOD);
        errors.holding = errors.holding.max(distance(&state.q, &start.q));
    }
    for step in 0..steps(motion) {
        let time = step as f64 * PERIOD;
        let tau = control::computed_torque(&state, &trajectory::at(time));
        state = plant.step(&state, &tau, PERIOD);
        let target = trajectory::at(time + PERIOD);
        errors.tracking = errors.tracking.max(distance(&state.q, &target.q));
    }
    errors
}

fn steps(duration: f64) -> u32 {
    (duration / PERIOD).round() as u32
}

fn distance(left: &Joints, right: &Joints) -> f64 {
    let differences = left.iter().zip(right).map(|(l, r)| (l - r).abs());
    differences.fold(0.0, f64::max)
}
