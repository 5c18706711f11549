//! The robot stands still, steps without slipping, and its energy is accounted for.

use example_shared::assert_shown;
use stand::balance::command;
use stand::ground::{accelerations, step, touch_down};
use stand::walk::walk;
use stand::{BENT, LEGS, Rates, Stance, State, go2};

#[test]
fn a_shared_weight_leaves_nothing_to_move() {
    let state = State::at_rest();
    let standing = command(&state, Stance::Four, &state.pose, &[BENT; LEGS]);
    let (rates, forces) = accelerations(&state, Stance::Four, &standing.tau);
    assert!(rates.amax() < 1e-5, "{rates}");
    let weight: f64 = forces.iter().skip(2).step_by(3).sum();
    let mass = go2::inertia(&state.q)[go2::BASE][go2::BASE];
    assert!((weight - 9.81 * mass).abs() < 1e-5, "{weight}");
    for (found, expected) in forces.iter().zip(standing.forces) {
        assert!((found - expected).abs() < 1e-4, "{found} {expected}");
    }
    // The joints' part of gravity alone lets it sink: in flight it does not hold a leg up.
    let g = state.gravity();
    let still = Rates::zeros().into();
    let mut tau = Rates::from(go2::inverse_dynamics(&state.q, &still, &still, &g));
    tau.fixed_rows_mut::<6>(go2::BASE).fill(0.0);
    let (rates, _) = accelerations(&state, Stance::Four, &tau);
    assert!(rates[go2::BASE + 2] < -5.0, "{rates}");
}

#[test]
fn two_steps_keep_their_energy() {
    let report = walk();
    assert!(report.energy_error < 1e-4, "{report:?}");
    assert!(report.slip < 3e-4, "{report:?}");
    assert!(report.least_force > 10.0, "{report:?}");
    let [left, right] = report.forward;
    assert!(left > 0.02 && right > 0.02, "{report:?}");
    assert!(report.farthest[1] < 0.05, "{report:?}");
    assert!(report.state.v.amax() < 1e-2, "{report:?}");
    assert!(report.lost > 0.0);
}

/// The midpoint rule is of second order: half the period leaves a quarter of the error.
#[test]
fn the_error_of_the_energy_is_the_integrator_s() {
    let error = |steps: u32| {
        let mut state = State::at_rest();
        state.v[go2::BASE + 4] = 0.3;
        let (mut state, _) = touch_down(&state);
        let tau = command(&state, Stance::Four, &state.pose, &[BENT; LEGS]).tau * 1.1;
        let (before, mut work) = (state.energy(), 0.0);
        for _ in 0..steps {
            let (next, step_work) = step(&state, Stance::Four, &tau, 0.1 / f64::from(steps));
            (state, work) = (next, work + step_work);
        }
        (state.energy() - before - work).abs()
    };
    let [coarse, fine] = [error(50), error(100)];
    assert!(coarse < 1e-2 && fine < 0.3 * coarse, "{coarse} {fine}");
}

/// The plan stands beside a copy, which is no other robot.
#[test]
fn the_robot_is_the_gallery_s() {
    let gallery = include_str!("../../../gallery/robots/go2.toml");
    assert_eq!(include_str!("../robots/go2.toml"), gallery);
}

#[test]
fn the_example_prints_what_the_page_shows() {
    assert_shown(env!("CARGO_BIN_EXE_stand"), include_str!("../README.md"));
}
