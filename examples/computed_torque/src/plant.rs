//! The arm that is moved: its forward dynamics, generated from its own robot file.

use crate::{Joints, loaded, puma560};

/// Where the arm is and how fast it moves.
pub type State = example_shared::integrate::State<{ puma560::N }>;

/// Which arm it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Plant {
    /// The arm that the controller knows.
    Nominal,
    /// The same with a payload that it does not know of.
    Loaded,
}

impl Plant {
    /// The state after `period` seconds of constant torques.
    pub fn step(self, state: &State, tau: &Joints, period: f64) -> State {
        let acceleration = match self {
            Plant::Nominal => puma560::forward_dynamics,
            Plant::Loaded => loaded::forward_dynamics,
        };
        state.step(period, |state| acceleration(&state.q, &state.qd, tau))
    }
}
