//! The controller on the arm that carries what it does not know.

use example_shared::integrate::{distance, largest};

use crate::control::{Controller, GAIN, Wish};
use crate::trajectory::{self, Target};
use crate::{Joints, Parameters, State, arm, loaded};

/// The period of the controller, s.
pub const PERIOD: f64 = 1e-3;

/// Measurements at one period.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// When, s.
    pub time: f64,
    /// Largest distance of a joint from its target, rad.
    pub error: f64,
    /// Largest distance of a torque of the estimate, Y π̂, from that of the arm with its
    /// payload, N·m.
    pub torque_error: f64,
    /// V, the energy of the error, with the Γ of a controller that learns.
    pub energy: f64,
}

/// A run, a sample a period.
#[derive(Clone, Debug)]
pub struct Run {
    /// From the first on.
    pub samples: Vec<Sample>,
}

impl Run {
    /// Returns the largest of something in the last second.
    pub fn at_last(&self, of: fn(&Sample) -> f64) -> f64 {
        let second = (1.0 / PERIOD) as usize;
        largest(self.samples.iter().rev().take(second).map(of))
    }
}

/// Follows the trajectory for so many seconds.
pub fn run(mut controller: Controller, duration: f64) -> Run {
    let mut state = State {
        q: trajectory::at(0.0).q,
        qd: [0.0; arm::N],
    };
    let mut samples = Vec::new();
    for step in 0..(duration / PERIOD).round() as u32 {
        let time = f64::from(step) * PERIOD;
        let target = trajectory::at(time);
        samples.push(Sample {
            time,
            error: distance(&state.q, &target.q),
            torque_error: torque_error(&state, &target, &controller),
            energy: energy(&state, &target, &controller.estimate),
        });
        let tau = controller.torques(&state, &target, PERIOD);
        state = moved(&state, &tau, PERIOD);
    }
    Run { samples }
}

/// Returns the state of the arm with its payload after `period` seconds of constant torques.
pub fn moved(state: &State, tau: &Joints, period: f64) -> State {
    state.step(period, |state| {
        loaded::forward_dynamics(&state.q, &state.qd, tau)
    })
}

fn torque_error(state: &State, target: &Target, controller: &Controller) -> f64 {
    let Wish { v, a, .. } = Wish::new(state, target);
    let y = arm::passivity_regressor(&state.q, &state.qd, &v, &a);
    let estimate = y.map(|row| crate::control::product(&row, &controller.estimate));
    distance(&estimate, &loaded::passivity(&state.q, &state.qd, &v, &a))
}

/// V = ½ sᵀD s + ½ (π̂ − π)ᵀ Γ⁻¹ (π̂ − π), with D and π of the arm with its payload.
pub fn energy(state: &State, target: &Target, estimate: &Parameters) -> f64 {
    let s = Wish::new(state, target).s;
    let d = loaded::inertia(&state.q);
    let mut twice = 0.0;
    for (row, si) in d.iter().zip(&s) {
        twice += si * row.iter().zip(&s).map(|(d, sk)| d * sk).sum::<f64>();
    }
    for (estimate, own) in estimate.iter().zip(&loaded::PASSIVITY_PARAMETERS) {
        twice += (estimate - own) * (estimate - own) / GAIN;
    }
    twice / 2.0
}
