//! Tests the controller against its theory.

use std::process::Command;

use adaptive_control::control::{Controller, DAMPING, Wish};
use adaptive_control::run::{energy, moved};
use adaptive_control::{Joints, Parameters, State, arm, loaded, run, trajectory};
use example_shared::integrate::distance;

#[test]
fn what_is_learned_is_what_the_arm_carries() {
    let (adaptive, fixed) = (
        run(Controller::adaptive(), 20.0),
        run(Controller::fixed(), 20.0),
    );
    let error = |run: &adaptive_control::Run| run.at_last(|sample| sample.error);
    let torque = |run: &adaptive_control::Run| run.at_last(|sample| sample.torque_error);
    assert!(error(&adaptive) < error(&fixed) / 10.0);
    assert!(torque(&adaptive) < torque(&fixed) / 10.0);
}

/// dV/dt = −sᵀ(K + b) s, whatever the estimate and wherever the arm is.
#[test]
fn the_energy_of_the_error_falls_as_it_should() {
    for step in 0..200 {
        let off = rate_is_off(step, arm::passivity_regressor);
        assert!(off < 1e-4, "{off}");
    }
}

/// With the regressor of the torques, in which C(q, v) v stands for C(q, q̇) v, it is not,
/// but for where q̇ happens to be v.
#[test]
fn the_regressor_of_the_torques_will_not_do() {
    let off = |step| rate_is_off(step, |q, _, v, a| loaded::regressor(q, v, a));
    let wrong = (0..200).filter(|&step| off(step) > 1e-2).count();
    assert!(wrong > 100, "{wrong}");
}

type Regressor = fn(&Joints, &Joints, &Joints, &Joints) -> [Parameters; arm::N];

/// Returns how far the rate of V is from −sᵀ(K + b) s, relative to it, near the trajectory.
fn rate_is_off(step: u32, regressor: Regressor) -> f64 {
    let time = 0.1 * f64::from(step);
    let target = trajectory::at(time);
    let wave = |k: f64| -> Joints { core::array::from_fn(|i| libm::sin(k * time + i as f64)) };
    let (dq, dqd) = (wave(5.0), wave(7.0));
    let state = State {
        q: core::array::from_fn(|i| target.q[i] + 0.4 * dq[i]),
        qd: core::array::from_fn(|i| target.qd[i] + 1.2 * dqd[i]),
    };
    let mut controller = Controller::adaptive();
    for (k, estimate) in controller.estimate.iter_mut().enumerate() {
        *estimate += 0.2 * libm::sin(k as f64 + time);
    }
    let Wish { v, a, s } = Wish::new(&state, &target);
    let before = energy(&state, &target, &controller.estimate);
    // The torques stay as they are meanwhile, and so does the rate of the estimate.
    let fallen = |period: f64| {
        let mut controller = controller.clone();
        let y = regressor(&state.q, &state.qd, &v, &a);
        let tau = controller.answer(&y, &s, period);
        let (moved, target) = (moved(&state, &tau, period), trajectory::at(time + period));
        (before - energy(&moved, &target, &controller.estimate)) / period
    };
    // The error of a difference is halved with its step: what is left is of second order.
    let found = 2.0 * fallen(0.5e-6) - fallen(1e-6);
    let viscous = [0.0, 0.0, 0.05];
    let power: f64 = (0..3)
        .map(|i| (DAMPING[i] + viscous[i]) * s[i] * s[i])
        .sum();
    (found - power).abs() / power
}

/// Y π of the arm with its payload is D a + C v + c + b∘v; the payload does not change Y.
#[test]
fn the_regressor_is_that_of_the_passivity_form() {
    let (q, qd, v, a) = (
        [0.3, 0.9, -1.1],
        [1.0, -2.0, 1.5],
        [0.4, 1.2, -0.7],
        [3.0, 1.0, -4.0],
    );
    let y = arm::passivity_regressor(&q, &qd, &v, &a);
    assert!(distance(&y[1], &loaded::passivity_regressor(&q, &qd, &v, &a)[1]) < 1e-12);
    let product =
        y.map(|row| adaptive_control::control::product(&row, &loaded::PASSIVITY_PARAMETERS));
    assert!(distance(&product, &loaded::passivity(&q, &qd, &v, &a)) < 1e-12);
}

#[test]
fn the_example_prints_what_the_guide_shows() {
    let run = Command::new(env!("CARGO_BIN_EXE_adaptive_control")).output();
    let output = run.unwrap();
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{text}");
    let guide = include_str!("../../../docs/src/adaptive.md");
    assert!(
        guide.contains(&*text),
        "the guide shows something else:\n{text}"
    );
}
