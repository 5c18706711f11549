//! A step of the arm and its slopes.

use nalgebra::{SMatrix, SVector};

use crate::planar2r;

/// q₁, q₂, q̇₁, q̇₂: rad, rad/s.
pub type State = SVector<f64, 4>;
/// Slopes by the state.
pub type Square = SMatrix<f64, 4, 4>;
/// Second derivatives by the state and, last, the torque.
pub type Bend = SMatrix<f64, 5, 5>;

/// Hanging at rest; q₁ is counted from the horizontal.
pub const HANGING: State = State::new(-core::f64::consts::FRAC_PI_2, 0.0, 0.0, 0.0);
/// Upright at rest.
pub const UPRIGHT: State = State::new(core::f64::consts::FRAC_PI_2, 0.0, 0.0, 0.0);

/// Returns the state after `period` seconds of a torque at the elbow, by one step of the
/// classical Runge–Kutta method.
pub fn step(state: &State, torque: f64, period: f64) -> State {
    let k1 = rate(state, torque);
    let k2 = rate(&(state + k1 * (period / 2.0)), torque);
    let k3 = rate(&(state + k2 * (period / 2.0)), torque);
    let k4 = rate(&(state + k3 * period), torque);
    state + (k1 + (k2 + k3) * 2.0 + k4) * (period / 6.0)
}

/// Returns the slopes of [`step`] by the state and by the torque: the chain rule through its
/// four stages.
pub fn slopes(state: &State, torque: f64, period: f64) -> (Square, State) {
    let mut at = *state;
    let (mut by_state, mut by_torque) = (Square::identity(), State::zeros());
    let (mut sum_state, mut sum_torque) = (Square::zeros(), State::zeros());
    for (weight, next) in [(1.0, 0.5), (2.0, 0.5), (2.0, 1.0), (1.0, 0.0)] {
        let (own_state, own_torque) = rate_slopes(&at, torque);
        let along = rate(&at, torque);
        by_torque = own_state * by_torque + own_torque;
        by_state = own_state * by_state;
        sum_state += by_state * weight;
        sum_torque += by_torque * weight;
        let ahead = next * period;
        at = state + along * ahead;
        by_state = Square::identity() + by_state * ahead;
        by_torque *= ahead;
    }
    let sixth = period / 6.0;
    (Square::identity() + sum_state * sixth, sum_torque * sixth)
}

/// Returns the second derivatives of λᵀ[`step`] by state and torque. Backward through the four
/// stages: of the rate of each the step counts λᵀ times its weight, and what the stage after
/// makes of it.
pub fn bends(state: &State, torque: f64, period: f64, multiplier: &State) -> Bend {
    let mut at = *state;
    let mut by_both = Bend::identity();
    let stages = [0.5, 0.5, 1.0, 0.0].map(|next| {
        let (own_state, own_torque) = rate_slopes(&at, torque);
        let stage = (at, by_both, own_state);
        let ahead = next * period;
        let moved = own_state * by_both.fixed_rows::<4>(0) + own_torque * by_both.row(4);
        at = state + rate(&at, torque) * ahead;
        by_both = Bend::identity();
        let mut rows = by_both.fixed_rows_mut::<4>(0);
        rows += moved * ahead;
        stage
    });
    let mut bends = Bend::zeros();
    // What the stage after makes of this one's rate.
    let mut onward = State::zeros();
    for (weight, next, (at, by_both, own_state)) in [
        (1.0, 0.0, stages[3]),
        (2.0, 1.0, stages[2]),
        (2.0, 0.5, stages[1]),
        (1.0, 0.5, stages[0]),
    ] {
        let counted = multiplier * (weight * period / 6.0) + onward * (next * period);
        bends += by_both.transpose() * rate_bends(&at, torque, &counted) * by_both;
        onward = own_state.transpose() * counted;
    }
    bends
}

/// Returns the second derivatives of λᵀ(q̇, q̈), of which q̇ has none.
fn rate_bends(state: &State, torque: f64, multiplier: &State) -> Bend {
    let [q1, q2, qd1, qd2] = (*state).into();
    let own = planar2r::forward_dynamics_second_derivatives(
        &[q1, q2],
        &[qd1, qd2],
        &[0.0, torque],
        &[multiplier[2], multiplier[3]],
    );
    let mut bends = Bend::zeros();
    for i in 0..planar2r::N {
        for k in 0..planar2r::N {
            bends[(i, k)] = own.d2qdd_dq_dq[i][k];
            bends[(i, 2 + k)] = own.d2qdd_dq_dqd[i][k];
            bends[(2 + k, i)] = own.d2qdd_dq_dqd[i][k];
            bends[(2 + i, 2 + k)] = own.d2qdd_dqd_dqd[i][k];
        }
        bends[(4, i)] = own.d2qdd_dtau_dq[1][i];
        bends[(i, 4)] = own.d2qdd_dtau_dq[1][i];
    }
    bends
}

/// (q̇, q̈) under a torque at the elbow.
fn rate(state: &State, torque: f64) -> State {
    let [q1, q2, qd1, qd2] = (*state).into();
    let [qdd1, qdd2] = planar2r::forward_dynamics(&[q1, q2], &[qd1, qd2], &[0.0, torque]);
    State::new(qd1, qd2, qdd1, qdd2)
}

/// Returns the slopes of (q̇, q̈).
fn rate_slopes(state: &State, torque: f64) -> (Square, State) {
    let [q1, q2, qd1, qd2] = (*state).into();
    let slopes = planar2r::forward_dynamics_derivatives(&[q1, q2], &[qd1, qd2], &[0.0, torque]);
    let (mut by_state, mut by_torque) = (Square::zeros(), State::zeros());
    for i in 0..planar2r::N {
        by_state[(i, 2 + i)] = 1.0;
        for k in 0..planar2r::N {
            by_state[(2 + i, k)] = slopes.dqdd_dq[i][k];
            by_state[(2 + i, 2 + k)] = slopes.dqdd_dqd[i][k];
        }
        by_torque[2 + i] = slopes.dqdd_dtau[i][1];
    }
    (by_state, by_torque)
}
