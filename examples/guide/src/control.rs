//! A controller: inverse dynamics at a corrected acceleration.

use crate::simulate::{State, step};
use crate::{Joints, arm};

/// Each joint follows as a critically damped system of this frequency, rad/s.
const FREQUENCY: f64 = 20.0;

/// The reference motion: position, velocity and acceleration.
pub struct Target {
    pub q: Joints,
    pub qd: Joints,
    pub qdd: Joints,
}

/// Returns the target at a time, s: every joint swings by half a radian, each 1 rad out of phase.
pub fn target(time: f64) -> Target {
    let swing = |i: usize| 0.5 * (time + i as f64).sin();
    let rate = |i: usize| 0.5 * (time + i as f64).cos();
    Target {
        q: std::array::from_fn(swing),
        qd: std::array::from_fn(rate),
        qdd: std::array::from_fn(|i| -swing(i)),
    }
}

/// Returns τ = D(q)(q̈ + 2ω ė + ω² e) + h(q, q̇) + c(q) + b∘q̇.
pub fn torques(state: &State, target: &Target) -> Joints {
    let wanted = std::array::from_fn(|i| {
        let (error, rate) = (target.q[i] - state.q[i], target.qd[i] - state.qd[i]);
        target.qdd[i] + 2.0 * FREQUENCY * rate + FREQUENCY * FREQUENCY * error
    });
    arm::inverse_dynamics(&state.q, &state.qd, &wanted)
}

/// Runs the arm and its controller for some seconds at 1 kHz. Returns the largest error of a joint
/// in the second half, when the error at the start has died away.
pub fn follow(seconds: u32) -> f64 {
    const PERIOD: f64 = 1e-3;
    let (q, qd) = ([0.0; arm::N], [0.0; arm::N]);
    let mut state = State { q, qd };
    let steps = seconds * 1000;
    let mut worst = 0.0f64;
    for n in 0..steps {
        let time = f64::from(n) * PERIOD;
        let tau = torques(&state, &target(time));
        state = step(&state, &tau, PERIOD);
        if n > steps / 2 {
            let wanted = target(time + PERIOD).q;
            let errors = state.q.iter().zip(&wanted).map(|(q, w)| (q - w).abs());
            worst = errors.fold(worst, f64::max);
        }
    }
    worst
}
