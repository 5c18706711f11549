//! The checked-in certificates hold. Their operations are bars, which only ever go
//! down; the searches took minutes.

use std::path::Path;

use serde_json::Value;

use crate::support::planar::json;
use crate::support::{good, run, temporary};

/// Torques of the PUMA over the box of its file.
fn holds(name: &str, relative_to: &str, tolerance: f64, operations: usize) {
    let generated = Path::new(env!("CARGO_MANIFEST_DIR")).join("../generated");
    let file = generated.join("certificates").join(name);
    let robot = generated.join("robots/puma560.toml");
    let (file, robot) = (file.to_str().unwrap(), robot.to_str().unwrap());
    let certificate = json(file);
    let steps = certificate["emitted"]["steps"].as_array().unwrap();
    assert!(steps.len() <= operations, "{}", steps.len());
    assert_eq!(certificate["relative_to"], relative_to);
    let total = certificate["total"].as_array().unwrap();
    assert!(total.iter().all(|e| e.as_f64().unwrap() <= tolerance));
    for (key, limits) in [
        ("position", [std::f64::consts::PI; 6]),
        ("velocity", [2.0, 2.0, 2.0, 5.0, 5.0, 5.0]),
        ("acceleration", [10.0, 10.0, 10.0, 30.0, 30.0, 30.0]),
    ] {
        let ranges = certificate[key].as_array().unwrap();
        assert_eq!(ranges.len(), limits.len());
        for (range, limit) in ranges.iter().zip(limits) {
            let [low, high] = [0, 1].map(|end| range[end].as_f64().unwrap());
            assert!(low <= -limit && high >= limit, "{range}");
        }
    }
    let ran = good(&["certify", file, "--robot", robot]);
    assert_eq!(ran.out.matches("  E holds\n").count(), 6, "{}", ran.out);
}

#[test]
fn the_puma_at_a_thousandth_of_its_actuators_limits() {
    holds("puma560-actuator-1e-3.json", "actuator", 1e-3, 201);
}

#[test]
fn the_puma_at_a_hundredth_of_its_ranges() {
    holds("puma560-range-1e-2.json", "range", 1e-2, 197);
}

/// Every function of a generated file, without a certificate.
#[test]
fn a_whole_file() {
    let generated = Path::new(env!("CARGO_MANIFEST_DIR")).join("../generated/robots");
    let file = generated.join("planar2r.rs");
    let robot = generated.join("planar2r.toml");
    let (file, robot) = (file.to_str().unwrap(), robot.to_str().unwrap());
    let ran = good(&["certify", file, "--robot", robot]);
    assert_eq!(ran.out.matches("  shown\n").count(), 6, "{}", ran.out);
    let changed = temporary("whole").join("arm.rs");
    let source = std::fs::read_to_string(file).unwrap();
    std::fs::write(&changed, source.replacen("14.715", "14.716", 1)).unwrap();
    let ran = run(&["certify", changed.to_str().unwrap(), "--robot", robot]);
    assert_eq!(ran.code, 1, "{}{}", ran.out, ran.err);
    ran.says(&["not every function"]);
    let ran = good(&["certify", file, "--robot", robot, "--json"]);
    let said: Value = serde_json::from_str(&ran.out).unwrap();
    let functions = said["functions"].as_array().unwrap();
    assert!(
        functions.iter().all(|found| found["passed"] == true),
        "{said}"
    );
    let ran = run(&["certify", file, "--robot", robot, "--tolerance", "1"]);
    assert_eq!(ran.code, 2, "{}{}", ran.out, ran.err);
    ran.says(&["--tolerance is for a certificate"]);
}

/// A file of another robot is said to be so, and nothing else; of one of this robot before an edit it is
/// said before what is not shown.
#[test]
fn another_robot_is_named_first() {
    let generated = Path::new(env!("CARGO_MANIFEST_DIR")).join("../generated");
    let path = |name: &str| generated.join(name).to_str().unwrap().to_owned();
    let certificate = path("certificates/puma560-range-1e-2.json");
    for (file, name) in [
        (path("robots/planar2r.rs"), "planar2r"),
        (certificate, "puma560"),
    ] {
        let ran = run(&["certify", &file, "--robot", &path("robots/stanford.toml")]);
        ran.ends(
            1,
            &[
                "is robot `stanford`, input ",
                "help: --robot takes the robot file",
            ],
        );
        let first = format!("error: `{file}` is of robot `{name}`, input ");
        assert!(
            ran.err.starts_with(&first) && ran.out.is_empty(),
            "{}{}",
            ran.out,
            ran.err
        );
    }
    let edited = temporary("edited").join("arm.toml");
    let planar = std::fs::read_to_string(path("robots/planar2r.toml")).unwrap();
    std::fs::write(&edited, planar.replacen("mass = 1", "mass = 1.5", 1)).unwrap();
    let robot = edited.to_str().unwrap();
    let ran = run(&["certify", &path("robots/planar2r.rs"), "--robot", robot]);
    ran.ends(1, &["it was edited since", "not every function"]);
    assert!(
        ran.err.starts_with("note: `") && ran.out.contains("not shown"),
        "{}",
        ran.err
    );
}
