//! The arm swings up and stays up, and does not without the plan's gains.

use example_shared::assert_shown;
use nalgebra::{SMatrix, SVector};
use swing_up::LIMIT;
use swing_up::follow::follow;
use swing_up::model::{State, bends, slopes, step};
use swing_up::plan::{Derivatives, Plan, plan};

#[test]
fn the_arm_swings_up_and_stays() {
    let [first, second] = [Derivatives::First, Derivatives::Second].map(plan);
    for plan in [&first, &second] {
        let falls = plan.costs.windows(2).all(|pair| pair[1] < pair[0]);
        assert!(falls, "{:?}", plan.costs);
        assert!(plan.off().abs().max() < 1e-2, "{}", plan.off());
        assert!(plan.torques.iter().all(|torque| torque.abs() <= LIMIT));
    }
    let rounds = |plan: &Plan| plan.costs.len() - 1;
    assert!(3 * rounds(&second) < 2 * rounds(&first));
    assert!(second.cost() <= first.cost());
    let [off, most] = follow(&second, 3.0, 0.05);
    assert!(off < 1e-3 && most <= LIMIT, "{off} {most}");
    // Without the plan's gains a push is not corrected.
    let mut deaf = second;
    deaf.gains.fill(State::zeros());
    assert!(follow(&deaf, 0.0, 0.05)[0] > 0.1);
}

const STATE: State = State::new(-0.9, -1.1, 2.0, -3.0);
const TORQUE: f64 = 1.5;
const PERIOD: f64 = 0.02;

/// Returns the central differences of a function at [`STATE`] and, in the last column, [`TORQUE`].
fn differences<const N: usize>(of: impl Fn(&State, f64) -> SVector<f64, N>) -> SMatrix<f64, N, 5> {
    let tiny = 1e-6;
    let column = |k: usize| {
        let mut off = SVector::<f64, 5>::zeros();
        off[k] = tiny;
        let (state, torque) = (off.fixed_rows::<4>(0), off[4]);
        let there = of(&(STATE + state), TORQUE + torque);
        (there - of(&(STATE - state), TORQUE - torque)) / (2.0 * tiny)
    };
    SMatrix::from_columns(&[0, 1, 2, 3, 4].map(column))
}

#[test]
fn slopes_are_those_of_the_step() {
    let found = slopes(&STATE, TORQUE, PERIOD);
    let expected = differences(|state, torque| step(state, torque, PERIOD));
    assert!((found - expected).abs().max() < 1e-8);
}

#[test]
fn bends_are_those_of_the_step() {
    let multiplier = State::new(0.3, -0.8, 1.2, 0.5);
    let found = bends(&STATE, TORQUE, PERIOD, &multiplier);
    let expected =
        differences(|state, torque| slopes(state, torque, PERIOD).transpose() * multiplier);
    assert!((found - expected).abs().max() < 1e-8);
}

#[test]
fn the_example_prints_what_the_guide_shows() {
    let guide = include_str!("../README.md");
    assert_shown(env!("CARGO_BIN_EXE_swing_up"), guide);
}
