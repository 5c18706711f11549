//! Tests the controller against its theory.

use adaptive_control::control::{Controller, DAMPING, GAIN, Wish, product};
use adaptive_control::run::{energy, moved, target};
use adaptive_control::{Joints, Parameters, State, arm, loaded};
use example_shared::assert_shown;

/// dV/dt = −sᵀ(K + b) s for any estimate and any state.
#[test]
fn the_energy_of_the_error_falls_as_it_should() {
    for step in 0..200 {
        let off = rate_is_off(step, arm::passivity_regressor);
        assert!(off < 1e-4, "{off}");
    }
}

/// With the regressor of the torques, which has C(q, v) v instead of C(q, q̇) v, the equation
/// fails unless q̇ happens to be v.
#[test]
fn the_regressor_of_the_torques_will_not_do() {
    let off = |step| rate_is_off(step, |q, _, v, a| loaded::regressor(q, v, a));
    let wrong = (0..200).filter(|&step| off(step) > 1e-2).count();
    assert!(wrong > 100, "{wrong}");
}

type Regressor = fn(&Joints, &Joints, &Joints, &Joints) -> [Parameters; arm::N];

/// Returns the relative error of dV/dt = −sᵀ(K + b) s at a state near the trajectory.
fn rate_is_off(step: u32, regressor: Regressor) -> f64 {
    let time = 0.1 * f64::from(step);
    let wanted = target(time);
    let wave = |k: f64| -> Joints { core::array::from_fn(|i| libm::sin(k * time + i as f64)) };
    let (dq, dqd) = (wave(5.0), wave(7.0));
    let state = State {
        q: core::array::from_fn(|i| wanted.q[i] + 0.4 * dq[i]),
        qd: core::array::from_fn(|i| wanted.qd[i] + 1.2 * dqd[i]),
    };
    let mut controller = Controller::new(GAIN);
    for (k, estimate) in controller.estimate.iter_mut().enumerate() {
        *estimate += 0.2 * libm::sin(k as f64 + time);
    }
    let Wish { v, a, s } = Wish::new(&state, &wanted);
    let before = energy(&state, &wanted, &controller.estimate);
    // The torques and the rate of the estimate are constant over the period.
    let fallen = |period: f64| {
        let mut controller = controller.clone();
        let y = regressor(&state.q, &state.qd, &v, &a);
        let tau = controller.answer(&y, &s, period);
        let (moved, wanted) = (moved(&state, &tau, period), target(time + period));
        (before - energy(&moved, &wanted, &controller.estimate)) / period
    };
    // Half the step halves the error of a difference: the combination is of second order.
    let rate = 2.0 * fallen(0.5e-6) - fallen(1e-6);
    let viscous = [0.0, 0.0, 0.05];
    let damped: Joints = core::array::from_fn(|i| (DAMPING[i] + viscous[i]) * s[i]);
    let power = product(&damped, &s);
    (rate - power).abs() / power
}

#[test]
fn the_example_prints_what_the_guide_shows() {
    let guide = include_str!("../README.md");
    assert_shown(env!("CARGO_BIN_EXE_adaptive_control"), guide);
}
