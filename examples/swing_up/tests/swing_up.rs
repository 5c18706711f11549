//! The arm comes up and stays up, and only by what it was planned with.

use std::process::Command;

use swing_up::model::{HANGING, State, bends, slopes, step};
use swing_up::plan::{Derivatives, Plan, plan};
use swing_up::{LIMIT, follow};

#[test]
fn the_arm_swings_up_and_stays() {
    let plan = plan(Derivatives::Second);
    let falls = plan.costs.windows(2).all(|pair| pair[1] < pair[0]);
    assert!(falls, "{:?}", plan.costs);
    assert!(plan.off().abs().max() < 1e-2, "{}", plan.off());
    assert!(plan.torques.iter().all(|torque| torque.abs() <= LIMIT));
    let run = follow(&plan, 3.0, 0.05);
    assert!(run.off() < 1e-3, "{}", run.end);
    assert!(run.samples.iter().all(|(.., torque)| torque.abs() <= LIMIT));
    // Without the plan's gains a push is not made up for.
    let mut deaf = plan.clone();
    deaf.gains.fill(State::zeros());
    assert!(follow(&deaf, 0.0, 0.05).off() > 0.1);
}

/// In fewer rounds, to a plan that is as good.
#[test]
fn second_derivatives_save_rounds() {
    let [first, second] = [Derivatives::First, Derivatives::Second].map(plan);
    let rounds = |plan: &Plan| plan.costs.len() - 1;
    assert!(
        3 * rounds(&second) < 2 * rounds(&first),
        "{}",
        rounds(&second)
    );
    assert!(second.cost() <= first.cost());
}

#[test]
fn slopes_are_those_of_the_step() {
    let state = HANGING + State::new(0.7, -1.1, 2.0, -3.0);
    let (torque, period) = (1.5, 0.02);
    let (by_state, by_torque) = slopes(&state, torque, period);
    let tiny = 1e-6;
    for k in 0..4 {
        let mut off = State::zeros();
        off[k] = tiny;
        let there = step(&(state + off), torque, period);
        let slope = (there - step(&(state - off), torque, period)) / (2.0 * tiny);
        assert!((slope - by_state.column(k)).abs().max() < 1e-8);
    }
    let there = step(&state, torque + tiny, period);
    let slope = (there - step(&state, torque - tiny, period)) / (2.0 * tiny);
    assert!((slope - by_torque).abs().max() < 1e-8);
}

#[test]
fn bends_are_those_of_the_step() {
    let state = HANGING + State::new(0.7, -1.1, 2.0, -3.0);
    let (torque, period) = (1.5, 0.02);
    let multiplier = State::new(0.3, -0.8, 1.2, 0.5);
    let found = bends(&state, torque, period, &multiplier);
    let slope = |state: &State, torque: f64| {
        let (by_state, by_torque) = slopes(state, torque, period);
        let of_state = by_state.transpose() * multiplier;
        of_state.push(by_torque.dot(&multiplier))
    };
    let tiny = 1e-6;
    for k in 0..5 {
        let mut off = State::zeros();
        if k < 4 {
            off[k] = tiny;
        }
        let pull = if k == 4 { tiny } else { 0.0 };
        let there = slope(&(state + off), torque + pull);
        let bend = (there - slope(&(state - off), torque - pull)) / (2.0 * tiny);
        assert!((bend - found.column(k)).abs().max() < 1e-8);
    }
}

#[test]
fn the_example_prints_what_the_guide_shows() {
    let run = Command::new(env!("CARGO_BIN_EXE_swing_up")).output();
    let output = run.unwrap();
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{text}");
    let guide = include_str!("../../../docs/src/swing-up.md");
    assert!(
        guide.contains(&*text),
        "the guide shows something else:\n{text}"
    );
}
