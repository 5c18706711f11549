//! `dalembert verify --extremes` as a user runs it.

use std::fs;

use crate::support::{good, robot, run, temporary};
use serde_json::Value;

/// The README's first robot: errors relative to a torque near zero are no alarm.
#[test]
fn a_robot_passes_with_a_table() {
    let verify = [
        "verify",
        &robot("planar2r"),
        "--outputs",
        "gravity",
        "--extremes",
    ];
    let ran = good(&verify);
    ran.prints(&["inside the limits", "angles 1e8", "chain of 20 joints"]);
    let json = good(&[&verify[..], &["--states", "3", "--json"]].concat());
    let json: Value = serde_json::from_str(&json.out).unwrap();
    assert_eq!(json["passed"], true);
    let rows = json["errors"].as_array().unwrap();
    let of = |case: &str| rows.iter().filter(|row| row["case"] == case).count();
    // Two scalars; what divides has four quantities more than it has functions.
    assert_eq!(
        [
            of("inside the limits"),
            of("normal"),
            of("chain of 20 joints")
        ],
        [2; 3]
    );
    assert!(of("nearest to singular") >= 2 * 6, "{}", ran.out);
    for row in rows {
        assert_eq!(row["verdict"], "ok");
        assert!(row["vector_in_u"].is_number() && row["entry_in_u"].is_number());
        let joints = row["state"]["q"].as_array().unwrap().len();
        assert_eq!(
            joints,
            if row["case"] == "chain of 20 joints" {
                20
            } else {
                2
            }
        );
    }
}

/// A robot whose D would be indefinite is refused, whatever is asked of it.
#[test]
fn an_arm_of_negative_energy_is_refused() {
    let folder = temporary("negative_energy");
    let robot = folder.join("negative_energy.toml");
    let robot = robot.to_str().unwrap();
    fs::write(robot, include_str!("data/negative_energy.toml")).unwrap();
    for arguments in [
        &["generate", robot, "--scene", "t"][..],
        &["verify", robot, "--extremes"],
    ] {
        let ran = run(arguments);
        assert_eq!(ran.code, 2, "{}", ran.err);
        let message = "negative_energy.toml:20:11\n";
        ran.says(&["a principal moment is negative", message]);
    }
}
