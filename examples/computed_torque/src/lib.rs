//! A PUMA 560 held on a trajectory by its inverse dynamics.
//!
//! - [`control`]: gravity compensation and computed torque, from the model
//! - [`plant`]: the arm that is moved, with or without a payload, by the forward
//!   dynamics generated from its own robot file
//! - [`trajectory`]: where it should be
//! - [`simulate`]: the three together, at 1 kHz
//! - [`chart`]: what came of it
//!
//! The controller knows the arm without payload. Its tracking error is tiny
//! if that is the arm, and not if the hand holds as little as 50 g: so the
//! check of the error can fail.
#![forbid(unsafe_code)]

pub mod chart;
pub mod control;
pub mod plant;
pub mod trajectory;

use example_shared::integrate::{distance, largest};
use plant::{Plant, State};

dalembert::dynamics! {
    /// The arm as the controller knows it.
    pub mod puma560 = "../../generated/robots/puma560.toml";
    outputs: inverse_dynamics, forward_dynamics;
    scalar: f64;
}

dalembert::dynamics! {
    /// The arm with a payload in its hand.
    pub mod loaded = "robots/loaded.toml";
    outputs: forward_dynamics;
    scalar: f64;
}

/// A value for each joint.
pub type Joints = [f64; puma560::N];

/// The period of the controller, s.
pub const PERIOD: f64 = 1e-3;

/// The tracking error of a run.
#[derive(Clone, Debug)]
pub struct Run {
    /// Largest distance of a joint while gravity compensation held it, rad.
    pub holding: f64,
    /// Largest distance of a joint at each period while it followed the
    /// trajectory: s, rad.
    pub tracking: Vec<[f64; 2]>,
}

impl Run {
    /// Largest distance of a joint while it followed the trajectory, rad.
    pub fn tracking(&self) -> f64 {
        largest(self.tracking.iter().map(|[_, distance]| *distance))
    }
}

/// Holds the arm for `hold` seconds, then moves it for `motion` seconds.
pub fn simulate(plant: Plant, hold: f64, motion: f64) -> Run {
    let start = trajectory::at(0.0);
    let mut state = State {
        q: start.q,
        qd: [0.0; puma560::N],
    };
    let mut run = Run {
        holding: 0.0,
        tracking: Vec::new(),
    };
    for _ in 0..steps(hold) {
        let tau = control::hold(&state, &start.q);
        state = plant.step(&state, &tau, PERIOD);
        run.holding = largest([run.holding, distance(&state.q, &start.q)].into_iter());
    }
    for step in 0..steps(motion) {
        let time = step as f64 * PERIOD;
        let tau = control::computed_torque(&state, &trajectory::at(time));
        state = plant.step(&state, &tau, PERIOD);
        let target = trajectory::at(time + PERIOD);
        let error = distance(&state.q, &target.q);
        run.tracking.push([time + PERIOD, error]);
    }
    run
}

fn steps(duration: f64) -> u32 {
    (duration / PERIOD).round() as u32
}
