//! The arm that is moved: its forward dynamics, generated from its own robot file.

use crate::{Joints, loaded, puma560};

/// Positions and velocities of the arm.
pub type State = example_shared::integrate::State<{ puma560::N }>;

/// The arm that is simulated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Plant {
    /// The arm that the controller knows.
    Nominal,
    /// The arm with a payload that the controller does not know of.
    Loaded,
}

impl Plant {
    /// Returns the state after `period` seconds of constant torques.
    pub fn step(self, state: &State, tau: &Joints, period: f64) -> State {
        let acceleration = match self {
            Plant::Nominal => puma560::forward_dynamics,
            Plant::Loaded => loaded::forward_dynamics,
        };
        state.step(period, |state| acceleration(&state.q, &state.qd, tau))
    }
}
