//! A push is found at its time and with its wrench; without a push nothing is found.

use collision::{Push, THRESHOLD, simulate};
use example_shared::{assert_shown, distance, largest};

const PUSH: Push = Push {
    during: 1.0..2.0,
    wrench: [20.0, -15.0, 10.0, 0.1, 0.05, -0.02],
};

#[test]
fn a_push_is_found_within_five_percent() {
    let samples = simulate(&PUSH, 2.5);
    let first = samples.iter().find(|noticed| noticed.torque > THRESHOLD);
    let time = first.unwrap().time;
    assert!((1.0..1.02).contains(&time), "{time}");
    for noticed in samples.iter().filter(|n| (1.3..2.0).contains(&n.time)) {
        let off = distance(&noticed.wrench, &PUSH.wrench);
        assert!(off <= 0.05 * largest(PUSH.wrench), "{noticed:?}");
    }
    // After the push nothing is noticed.
    let mut later = samples.iter().filter(|noticed| noticed.time > 2.3);
    assert!(later.all(|noticed| noticed.torque < THRESHOLD));
}

#[test]
fn an_arm_that_nothing_touches_notices_nothing() {
    let still = Push {
        wrench: [0.0; 6],
        ..PUSH
    };
    let samples = simulate(&still, 2.0);
    let most = largest(samples.iter().map(|noticed| noticed.torque));
    assert!(most < 1e-3 * THRESHOLD, "{most}");
}

#[test]
fn the_example_prints_what_the_guide_shows() {
    let guide = include_str!("../README.md");
    assert_shown(env!("CARGO_BIN_EXE_collision"), guide);
}
