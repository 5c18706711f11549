//! The arm as it moves under torques.

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
    let along = |rate: &State, time: f64| State {
        q: std::array::from_fn(|i| state.q[i] + time * rate.q[i]),
        qd: std::array::from_fn(|i| state.qd[i] + time * rate.qd[i]),
    };
    let rate = |state: &State| State {
        q: state.qd,
        qd: arm::forward_dynamics(&state.q, &state.qd, tau),
    };
    let k1 = rate(state);
    let k2 = rate(&along(&k1, period / 2.0));
    let k3 = rate(&along(&k2, period / 2.0));
    let k4 = rate(&along(&k3, period));
    let mean = |of: fn(&State) -> &Joints, i: usize| {
        (of(&k1)[i] + 2.0 * of(&k2)[i] + 2.0 * of(&k3)[i] + of(&k4)[i]) / 6.0
    };
    let slope = State {
        q: std::array::from_fn(|i| mean(|k| &k.q, i)),
        qd: std::array::from_fn(|i| mean(|k| &k.qd, i)),
    };
    along(&slope, period)
}
