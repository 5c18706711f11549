//! The residual r = K (p − p₀ − ∫ (τ + β + r) dt), which follows the external torques.

use crate::{Joints, PERIOD, State, ur10};

/// The bandwidth K, 1/s: r reaches the external torques after a few times 1/K.
const BANDWIDTH: f64 = 50.0;

/// The observer's state.
pub struct Observer {
    /// p₀ + ∫ (τ + β + r) dt
    expected: Joints,
    /// r
    outside: Joints,
}

impl Observer {
    /// Creates an observer at a state in which nothing touches the arm.
    pub fn new(state: &State) -> Observer {
        Observer {
            expected: ur10::momentum_observer(&state.q, &state.qd).p,
            outside: [0.0; ur10::N],
        }
    }

    /// Takes the torques of the drives over the period from one state to the next; returns the
    /// external torques. β is the mean of both ends.
    pub fn observe(&mut self, from: &State, to: &State, tau: &Joints) -> Joints {
        let before = ur10::momentum_observer(&from.q, &from.qd);
        let after = ur10::momentum_observer(&to.q, &to.qd);
        for (i, torque) in tau.iter().enumerate() {
            let drift = 0.5 * (before.drift[i] + after.drift[i]);
            self.expected[i] += PERIOD * (torque + drift + self.outside[i]);
            self.outside[i] = BANDWIDTH * (after.p[i] - self.expected[i]);
        }
        self.outside
    }
}
