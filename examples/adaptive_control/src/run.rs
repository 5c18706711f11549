//! Runs the controller at 1 kHz on the arm with an unknown payload.

use example_shared::{distance, largest};

use crate::control::{Controller, GAIN, Wish, product};
use crate::{Joints, Parameters, State, arm, loaded};

/// The period of the controller, s.
const PERIOD: f64 = 1e-3;

/// Target positions, velocities and accelerations, rad and s.
pub struct Target {
    pub q: Joints,
    pub qd: Joints,
    pub qdd: Joints,
}

/// The pose from which every joint swings, rad.
const CENTRE: Joints = [0.0, 0.4, -0.8];
/// Amplitudes at each frequency, rad.
const SWING: [Joints; 2] = [[0.6, 0.35, 0.5], [0.25, 0.15, 0.3]];
/// Frequencies, rad/s.
const FREQUENCY: [Joints; 2] = [[1.3, 1.7, 2.1], [3.7, 3.1, 4.3]];

/// Returns the target at a time, s: every joint swings with two frequencies, so that every parameter
/// is excited. Each adds amplitude (1 − cos ωt), so that the motion starts at rest.
pub fn target(time: f64) -> Target {
    let mut target = Target {
        q: CENTRE,
        qd: [0.0; arm::N],
        qdd: [0.0; arm::N],
    };
    for (swing, frequency) in SWING.iter().zip(&FREQUENCY) {
        for i in 0..arm::N {
            let (amplitude, frequency) = (swing[i], frequency[i]);
            let (sin, cos) = libm::sincos(frequency * time);
            target.q[i] += amplitude * (1.0 - cos);
            target.qd[i] += amplitude * frequency * sin;
            target.qdd[i] += amplitude * frequency * frequency * cos;
        }
    }
    target
}

/// Follows the trajectory for `duration` seconds. Returns the largest errors in the last second: of
/// a joint's position, rad, and of a torque of the estimate, Y π̂, against that of the arm with its
/// payload, N·m.
pub fn run(mut controller: Controller, duration: f64) -> [f64; 2] {
    let mut state = State::at_rest(target(0.0).q);
    let mut most = [0.0; 2];
    for step in 0..(duration / PERIOD).round() as u32 {
        let time = f64::from(step) * PERIOD;
        let target = target(time);
        if time >= duration - 1.0 {
            let error = distance(&state.q, &target.q);
            most[0] = largest([most[0], error]);
            most[1] = largest([most[1], torque_error(&state, &target, &controller)]);
        }
        let tau = controller.torques(&state, &target, PERIOD);
        state = moved(&state, &tau, PERIOD);
    }
    most
}

/// Returns the state of the arm with its payload after `period` seconds of constant torques.
pub fn moved(state: &State, tau: &Joints, period: f64) -> State {
    state.step(period, |at| loaded::forward_dynamics(&at.q, &at.qd, tau))
}

fn torque_error(state: &State, target: &Target, controller: &Controller) -> f64 {
    let Wish { v, a, .. } = Wish::new(state, target);
    let y = arm::passivity_regressor(&state.q, &state.qd, &v, &a);
    let estimate = y.map(|row| product(&row, &controller.estimate));
    distance(&estimate, &loaded::passivity(&state.q, &state.qd, &v, &a))
}

/// Returns V = ½ sᵀD s + ½ (π̂ − π)ᵀ Γ⁻¹ (π̂ − π), with D and π of the arm with its payload.
pub fn energy(state: &State, target: &Target, estimate: &Parameters) -> f64 {
    let s = Wish::new(state, target).s;
    let momentum = loaded::inertia(&state.q).map(|row| product(&row, &s));
    let off: Parameters = core::array::from_fn(|k| estimate[k] - loaded::PASSIVITY_PARAMETERS[k]);
    (product(&s, &momentum) + product(&off, &off) / GAIN) / 2.0
}
