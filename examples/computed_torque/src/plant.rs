//! The arm that is moved: its forward dynamics, integrated.

use nalgebra::{SMatrix, SVector};

use crate::{Joints, loaded, puma560};

type Vector = SVector<f64, { puma560::N }>;
type Matrix = SMatrix<f64, { puma560::N }, { puma560::N }>;

/// Which arm it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Plant {
    /// The arm that the controller knows.
    Nominal,
    /// The same with a payload that it does not know of.
    Loaded,
}

/// Where the arm is and how fast it moves.
#[derive(Clone, Copy, Debug)]
pub struct State {
    /// Joint angles, rad.
    pub q: Joints,
    /// Joint velocities, rad/s.
    pub qd: Joints,
}

impl Plant {
    /// The state after `period` seconds of constant torques: one step of the
    /// classical Runge–Kutta method.
    pub fn step(self, state: &State, tau: &Joints, period: f64) -> State {
        let along = |rate: &State, time: f64| State {
            q: core::array::from_fn(|i| state.q[i] + time * rate.q[i]),
            qd: core::array::from_fn(|i| state.qd[i] + time * rate.qd[i]),
        };
        let k1 = self.rate(state, tau);
        let k2 = self.rate(&along(&k1, period / 2.0), tau);
        let k3 = self.rate(&along(&k2, period / 2.0), tau);
        let k4 = self.rate(&along(&k3, period), tau);
        let mean = |of: fn(&State) -> &Joints, i: usize| {
            (of(&k1)[i] + 2.0 * of(&k2)[i] + 2.0 * of(&k3)[i] + of(&k4)[i]) / 6.0
        };
        let rate = State {
            q: core::array::from_fn(|i| mean(|k| &k.q, i)),
            qd: core::array::from_fn(|i| mean(|k| &k.qd, i)),
        };
        along(&rate, period)
    }

    /// (q̇, q̈) under these torques.
    fn rate(self, state: &State, tau: &Joints) -> State {
        State {
            q: state.qd,
            qd: self.acceleration(state, tau),
        }
    }

    /// Solves D q̈ = τ − h − c.
    fn acceleration(self, state: &State, tau: &Joints) -> Joints {
        let (d, h, c) = match self {
            Plant::Nominal => {
                let m = puma560::manipulator_equation(&state.q, &state.qd);
                (m.d, m.h, m.c)
            }
            Plant::Loaded => {
                let m = loaded::manipulator_equation(&state.q, &state.qd);
                (m.d, m.h, m.c)
            }
        };
        let inertia = Matrix::from_fn(|i, k| d[i][k]);
        let load = Vector::from_fn(|i, _| tau[i] - h[i] - c[i]);
        let factor = inertia.cholesky();
        let solution = factor.expect("an inertia matrix is positive definite");
        solution.solve(&load).into()
    }
}
