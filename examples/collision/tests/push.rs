//! A push is found when it comes and as it is, and nothing is found without one.

use collision::{Push, THRESHOLD, simulate};

const PUSH: Push = Push {
    during: [1.0, 2.0],
    wrench: [20.0, -15.0, 10.0, 0.1, 0.05, -0.02],
};

#[test]
fn a_push_is_found_within_five_percent() {
    let all = simulate(&PUSH, 2.5);
    let first = all.iter().find(|noticed| noticed.is_push()).unwrap();
    assert!((1.0..1.02).contains(&first.time), "{}", first.time);
    let largest = PUSH.wrench.iter().fold(0.0f64, |most, x| most.max(x.abs()));
    for noticed in all.iter().filter(|n| (1.3..2.0).contains(&n.time)) {
        for (found, given) in noticed.wrench.iter().zip(&PUSH.wrench) {
            let off = (found - given).abs();
            assert!(
                off <= 0.05 * largest,
                "{}: {:?}",
                noticed.time,
                noticed.wrench
            );
        }
    }
    // When it is over, it is gone.
    assert!(
        !all.iter()
            .any(|noticed| noticed.time > 2.3 && noticed.is_push())
    );
}

#[test]
fn an_arm_that_nothing_touches_notices_nothing() {
    let still = Push {
        wrench: [0.0; 6],
        ..PUSH
    };
    let all = simulate(&still, 2.0);
    let torques = all.iter().flat_map(|noticed| noticed.outside);
    let most = torques.fold(0.0f64, |most, x| most.max(x.abs()));
    assert!(most < 1e-3 * THRESHOLD, "{most}");
}
