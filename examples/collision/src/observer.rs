//! r = K (p − p₀ − ∫ (τ + β + r) dt), which follows the torques of what is outside.

use crate::{Joints, PERIOD, State, ur10};

/// The bandwidth K, 1/s: r reaches the torques after a few times 1/K.
const BANDWIDTH: f64 = 50.0;

/// The observer's memory.
pub struct Observer {
    /// p₀ + ∫ (τ + β + r) dt
    expected: Joints,
    /// r
    outside: Joints,
}

impl Observer {
    /// Begins at a state that nothing touches.
    pub fn new(state: &State) -> Observer {
        Observer {
            expected: ur10::momentum_observer(&state.q, &state.qd).p,
            outside: [0.0; ur10::N],
        }
    }

    /// Takes what the drives gave for a period from one state to the next; returns the torques
    /// of what is outside. β is the mean of both ends.
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
