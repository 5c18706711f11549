//! The law of Slotine and Li.

use crate::trajectory::Target;
use crate::{Joints, Parameters, State, arm};

/// Λ: how fast the error dies once s is zero, 1/s.
pub const LAMBDA: f64 = 8.0;
/// K, N·m·s.
pub const DAMPING: Joints = [8.0, 8.0, 3.0];
/// Γ: how fast what was learned changes.
pub const GAIN: f64 = 15.0;

/// A controller and what it takes the arm for.
#[derive(Clone, Debug)]
pub struct Controller {
    /// π̂: at first the empty arm.
    pub estimate: Parameters,
    /// Γ; zero for one that does not learn.
    pub gain: f64,
}

/// The reference motion at a state.
#[derive(Clone, Copy, Debug)]
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
        let v: Joints =
            core::array::from_fn(|i| target.qd[i] - LAMBDA * (state.q[i] - target.q[i]));
        Wish {
            v,
            a: core::array::from_fn(|i| target.qdd[i] - LAMBDA * (state.qd[i] - target.qd[i])),
            s: core::array::from_fn(|i| state.qd[i] - v[i]),
        }
    }
}

impl Controller {
    /// One that learns; it begins with the empty arm.
    pub fn adaptive() -> Controller {
        Controller {
            estimate: arm::PASSIVITY_PARAMETERS,
            gain: GAIN,
        }
    }

    /// Creates a controller that keeps the parameters of the empty arm.
    pub fn fixed() -> Controller {
        Controller {
            gain: 0.0,
            ..Controller::adaptive()
        }
    }

    /// τ = Y π̂ − K s; and for `period` seconds the estimate goes along −Γ Yᵀ s.
    pub fn torques(&mut self, state: &State, target: &Target, period: f64) -> Joints {
        let Wish { v, a, s } = Wish::new(state, target);
        let y = arm::passivity_regressor(&state.q, &state.qd, &v, &a);
        self.answer(&y, &s, period)
    }

    /// Computes the torques from Y and s.
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

/// Σ_k y_k π_k
pub fn product(row: &Parameters, parameters: &Parameters) -> f64 {
    row.iter().zip(parameters).map(|(y, pi)| y * pi).sum()
}
