//! A time step of the arm and its derivatives.

use nalgebra::{SMatrix, SVector};

use crate::planar2r;

/// q₁, q₂, q̇₁, q̇₂: rad, rad/s.
pub type State = SVector<f64, 4>;
/// Second derivatives with respect to the state.
pub type Square = SMatrix<f64, 4, 4>;
/// Derivatives of a state with respect to the state and, last, the torque.
pub type Slopes = SMatrix<f64, 4, 5>;
/// Second derivatives with respect to the state and, last, the torque.
pub type Bend = SMatrix<f64, 5, 5>;

/// Hanging at rest; q₁ is counted from the horizontal.
pub const HANGING: State = State::new(-core::f64::consts::FRAC_PI_2, 0.0, 0.0, 0.0);
/// Upright at rest.
pub const UPRIGHT: State = State::new(core::f64::consts::FRAC_PI_2, 0.0, 0.0, 0.0);

/// The stages of the classical Runge–Kutta method: six times the weight of each stage's rate, and
/// the fraction of the period by which that rate leads to the next stage.
const STAGES: [(f64, f64); 4] = [(1.0, 0.5), (2.0, 0.5), (2.0, 1.0), (1.0, 0.0)];

/// Returns the state after `period` seconds of a torque at the elbow, by one step of the
/// classical Runge–Kutta method.
pub fn step(state: &State, torque: f64, period: f64) -> State {
    let (mut at, mut sum) = (*state, State::zeros());
    for (weight, ahead) in STAGES {
        let rate = rate(&at, torque);
        sum += rate * weight;
        at = state + rate * (ahead * period);
    }
    state + sum * (period / 6.0)
}

/// A stage of a step: its state; the derivatives of its state and (last row) torque with respect to
/// those of the step; and the derivatives of its rate with respect to its own state and torque.
struct Stage(State, Bend, Slopes);

/// Returns the stages of a step; derivatives follow by the chain rule from each to the next.
fn stages(state: &State, torque: f64, period: f64) -> [Stage; 4] {
    let (mut at, mut by_both) = (*state, Bend::identity());
    STAGES.map(|(_, ahead)| {
        let slopes = rate_slopes(&at, torque);
        let stage = Stage(at, by_both, slopes);
        at = state + rate(&at, torque) * (ahead * period);
        let moved = slopes * by_both * (ahead * period);
        by_both = Bend::identity();
        let mut rows = by_both.fixed_rows_mut::<4>(0);
        rows += moved;
        stage
    })
}

/// Returns the derivatives of [`step`] with respect to the state and the torque.
pub fn slopes(state: &State, torque: f64, period: f64) -> Slopes {
    let mut sum = Slopes::zeros();
    for (Stage(_, by_both, slopes), (weight, _)) in stages(state, torque, period).iter().zip(STAGES)
    {
        sum += slopes * by_both * weight;
    }
    Slopes::identity() + sum * (period / 6.0)
}

/// Returns the second derivatives of λᵀ[`step`] with respect to state and torque. It goes backward
/// through the four stages: the multiplier of a stage's rate is λ times its weight, plus its
/// effect through the next stage.
pub fn bends(state: &State, torque: f64, period: f64, multiplier: &State) -> Bend {
    let (mut bends, mut onward) = (Bend::zeros(), State::zeros());
    let stages = stages(state, torque, period);
    for (Stage(at, by_both, slopes), (weight, ahead)) in stages.iter().zip(STAGES).rev() {
        let counted = multiplier * (weight * period / 6.0) + onward * (ahead * period);
        bends += by_both.transpose() * rate_bends(at, torque, &counted) * by_both;
        onward = slopes.fixed_columns::<4>(0).transpose() * counted;
    }
    bends
}

/// Returns the second derivatives of λᵀ(q̇, q̈); those of q̇ are zero.
fn rate_bends(state: &State, torque: f64, multiplier: &State) -> Bend {
    let [q1, q2, qd1, qd2] = (*state).into();
    let derivatives = planar2r::forward_dynamics_second_derivatives(
        &[q1, q2],
        &[qd1, qd2],
        &[0.0, torque],
        &[multiplier[2], multiplier[3]],
    );
    let mut bends = Bend::zeros();
    for i in 0..planar2r::N {
        for k in 0..planar2r::N {
            bends[(i, k)] = derivatives.d2qdd_dq_dq[i][k];
            bends[(i, 2 + k)] = derivatives.d2qdd_dq_dqd[i][k];
            bends[(2 + k, i)] = derivatives.d2qdd_dq_dqd[i][k];
            bends[(2 + i, 2 + k)] = derivatives.d2qdd_dqd_dqd[i][k];
        }
        bends[(4, i)] = derivatives.d2qdd_dtau_dq[1][i];
        bends[(i, 4)] = derivatives.d2qdd_dtau_dq[1][i];
    }
    bends
}

/// Returns (q̇, q̈) under a torque at the elbow.
fn rate(state: &State, torque: f64) -> State {
    let [q1, q2, qd1, qd2] = (*state).into();
    let [qdd1, qdd2] = planar2r::forward_dynamics(&[q1, q2], &[qd1, qd2], &[0.0, torque]);
    State::new(qd1, qd2, qdd1, qdd2)
}

fn rate_slopes(state: &State, torque: f64) -> Slopes {
    let [q1, q2, qd1, qd2] = (*state).into();
    let slopes = planar2r::forward_dynamics_derivatives(&[q1, q2], &[qd1, qd2], &[0.0, torque]);
    let mut matrix = Slopes::zeros();
    for i in 0..planar2r::N {
        matrix[(i, 2 + i)] = 1.0;
        for k in 0..planar2r::N {
            matrix[(2 + i, k)] = slopes.dqdd_dq[i][k];
            matrix[(2 + i, 2 + k)] = slopes.dqdd_dqd[i][k];
        }
        matrix[(2 + i, 4)] = slopes.dqdd_dtau[i][1];
    }
    matrix
}
