//! Moves the arm under torques.

use crate::{Joints, arm};

/// Positions and velocities of the arm.
#[derive(Clone, Copy, Debug)]
pub struct State {
    pub q: Joints,
    pub qd: Joints,
}

/// Returns the state after `period` seconds of constant torques: a step of the classical
/// Runge–Kutta method.
pub fn step(state: &State, tau: &Joints, period: f64) -> State {
    let along = |from: &State, rate: &State, time: f64| State {
        q: std::array::from_fn(|i| from.q[i] + time * rate.q[i]),
        qd: std::array::from_fn(|i| from.qd[i] + time * rate.qd[i]),
    };
    let (mut at, mut end) = (*state, *state);
    for (weight, ahead) in [(1.0, 0.5), (2.0, 0.5), (2.0, 1.0), (1.0, 0.0)] {
        let rate = State {
            q: at.qd,
            qd: arm::forward_dynamics(&at.q, &at.qd, tau),
        };
        end = along(&end, &rate, weight * period / 6.0);
        at = along(state, &rate, ahead * period);
    }
    end
}
