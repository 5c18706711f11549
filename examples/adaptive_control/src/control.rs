//! The law of Slotine and Li.

use crate::run::Target;
use crate::{Joints, Parameters, State, arm};

/// Λ: the rate at which the error decays once s is zero, 1/s.
const LAMBDA: f64 = 8.0;
/// K, N·m·s.
pub const DAMPING: Joints = [8.0, 8.0, 3.0];
/// Γ: how fast the estimate changes.
pub const GAIN: f64 = 15.0;

/// A controller and its estimate of the arm.
#[derive(Clone)]
pub struct Controller {
    /// π̂: at first that of the empty arm.
    pub estimate: Parameters,
    /// Γ; a controller with zero gain does not learn.
    pub gain: f64,
}

/// The reference motion at a state.
pub struct Wish {
    /// v = q̇_d − Λ(q − q_d), rad/s.
    pub v: Joints,
    /// a, the rate of v, rad/s².
    pub a: Joints,
    /// s = q̇ − v, rad/s.
    pub s: Joints,
}

impl Wish {
    /// Returns the reference motion towards a target.
    pub fn new(state: &State, target: &Target) -> Wish {
        let Target { q, qd, qdd } = target;
        let v: Joints = core::array::from_fn(|i| qd[i] - LAMBDA * (state.q[i] - q[i]));
        Wish {
            v,
            a: core::array::from_fn(|i| qdd[i] - LAMBDA * (state.qd[i] - qd[i])),
            s: core::array::from_fn(|i| state.qd[i] - v[i]),
        }
    }
}

impl Controller {
    /// Creates a controller whose first estimate is the empty arm; zero gain turns learning off.
    pub fn new(gain: f64) -> Controller {
        Controller {
            estimate: arm::PASSIVITY_PARAMETERS,
            gain,
        }
    }

    /// Returns τ = Y π̂ − K s, and moves the estimate along −Γ Yᵀ s for `period` seconds.
    pub fn torques(&mut self, state: &State, target: &Target, period: f64) -> Joints {
        let Wish { v, a, s } = Wish::new(state, target);
        let y = arm::passivity_regressor(&state.q, &state.qd, &v, &a);
        self.answer(&y, &s, period)
    }

    /// Computes the torques from Y and s, and moves the estimate.
    pub fn answer(&mut self, y: &[Parameters; arm::N], s: &Joints, period: f64) -> Joints {
        let tau = core::array::from_fn(|i| product(&y[i], &self.estimate) - DAMPING[i] * s[i]);
        for (row, s) in y.iter().zip(s) {
            for (estimate, y) in self.estimate.iter_mut().zip(row) {
                *estimate -= period * self.gain * y * s;
            }
        }
        tau
    }
}

/// Returns the scalar product.
pub fn product<const N: usize>(left: &[f64; N], right: &[f64; N]) -> f64 {
    left.iter().zip(right).map(|(l, r)| l * r).sum()
}
