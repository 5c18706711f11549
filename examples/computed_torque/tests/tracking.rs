//! The arm is held by a model that is right, and only by that.

use std::process::Command;

use computed_torque::plant::Plant;
use computed_torque::simulate;

#[test]
fn the_right_model_holds_the_arm() {
    let errors = simulate(Plant::Nominal, 0.2, 2.0);
    assert!(errors.holding < 1e-9, "{errors:?}");
    assert!(errors.tracking < 1e-4, "{errors:?}");
}

#[test]
fn the_wrong_model_does_not() {
    let errors = simulate(Plant::Loaded, 0.2, 2.0);
    assert!(errors.holding > 1e-2, "{errors:?}");
    assert!(errors.tracking > 1e-2, "{errors:?}");
}

#[test]
fn the_example_says_so() {
    let run = Command::new(env!("CARGO_BIN_EXE_computed_torque")).output();
    let output = run.unwrap();
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{text}");
}
