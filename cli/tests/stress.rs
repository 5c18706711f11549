//! `dalembert stress` as a user runs it.

use std::fs;

use crate::support::{good, robot, run, temporary};
use serde_json::Value;

#[test]
fn a_robot_passes_with_a_table() {
    let ran = good(&["stress", &robot("planar2r"), "--states", "5"]);
    assert!(ran.out.contains("angles 1e8") && ran.out.contains("D singular"));
    assert!(ran.out.contains("warning: where D is singular"));
    assert!(
        ran.out
            .contains("functions that divide, where D is nearest to singular")
    );
    for function in [
        "forward_dynamics",
        "inertia_inverse",
        "forward_dynamics_derivatives",
    ] {
        let lines = ran
            .out
            .lines()
            .filter(|line| line.trim_start().starts_with(function));
        let good = lines.filter(|line| line.trim_end().ends_with(" ok"));
        assert!(good.count() >= 4, "{function}: {}", ran.out);
    }
}

#[test]
fn json_says_the_same() {
    let ran = good(&["stress", &robot("planar2r"), "--states", "3", "--json"]);
    let json: Value = serde_json::from_str(&ran.out).unwrap();
    assert_eq!(json["passed"], true);
    let near = &json["near_singular"];
    assert!(near["condition_scaled"].as_f64().unwrap() > 16.0);
    let functions = near["functions"].as_array().unwrap();
    assert_eq!(functions.len(), 24, "six functions, two scalars, two codes");
    for row in functions {
        let [error, normwise, condition] =
            ["error_in_u_condition", "normwise_in_u", "condition_scaled"]
                .map(|key| row[key].as_f64().unwrap());
        assert!((error * condition / normwise - 1.0).abs() < 1e-12, "{row}");
        assert_eq!(row["verdict"], "ok");
    }
    let rows = json["rows"].as_array().unwrap();
    // Scalars and codes of each category.
    assert!(rows.len() > 80 && rows.len().is_multiple_of(4));
    for row in rows {
        assert_eq!(row["verdict"], "ok");
        let joints = if row["category"] == "chain of 20 joints" {
            20
        } else {
            2
        };
        assert_eq!(row["state"]["q"].as_array().unwrap().len(), joints);
        assert!(row["normwise_in_u"].is_number() && row["joint"].is_number());
    }
}

#[test]
fn without_a_robot_it_says_what_is_missing() {
    let ran = run(&["stress"]);
    assert_eq!(ran.code, 2);
    ran.says(&["<ROBOT>"]);
}

/// A robot whose D would be indefinite is refused, whatever is asked of it.
#[test]
fn an_arm_of_negative_energy_is_refused() {
    let folder = temporary("negative_energy");
    let robot = folder.join("negative_energy.toml");
    let robot = robot.to_str().unwrap();
    fs::write(robot, include_str!("data/negative_energy.toml")).unwrap();
    for arguments in [&["generate", robot, "--scene", "t"][..], &["stress", robot]] {
        let ran = run(arguments);
        assert_eq!(ran.code, 2, "{}", ran.err);
        let message = "negative_energy.toml:20:11\n";
        ran.says(&["a principal moment is negative", message]);
    }
}
