//! The arm is held by a model that is right, and only by that.

use std::process::Command;

use computed_torque::plant::Plant;
use computed_torque::{chart, simulate};
use example_shared::checked_in;

#[test]
fn the_right_model_holds_the_arm_and_the_wrong_one_does_not() {
    let right = simulate(Plant::Nominal, 0.2, 2.0);
    assert!(right.holding < 1e-9, "{}", right.holding);
    assert!(right.tracking() < 1e-4, "{}", right.tracking());
    let wrong = simulate(Plant::Loaded, 0.2, 2.0);
    assert!(wrong.holding > 1e-2, "{}", wrong.holding);
    assert!(wrong.tracking() > 1e-2, "{}", wrong.tracking());
    let path = checked_in::guide("computed_torque.svg");
    let same = checked_in::is(&path, &chart::svg(&right, &wrong)).unwrap();
    assert!(same, "written anew, look at it: {path:?}");
}

#[test]
fn the_example_prints_what_the_guide_shows() {
    let run = Command::new(env!("CARGO_BIN_EXE_computed_torque")).output();
    let output = run.unwrap();
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{text}");
    let guide = std::fs::read_to_string(checked_in::guide("controller.md")).unwrap();
    assert!(
        guide.contains(&*text),
        "the guide shows something else:\n{text}"
    );
}
