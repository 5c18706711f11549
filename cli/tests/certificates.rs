//! The checked-in certificates hold, all of them again: the program is proved,
//! the edits are applied and bounded, the text is read back. Their operations
//! are bars, which only ever go down; the searches took minutes.

mod support;

use std::path::Path;

use dalembert_codegen::certify::json::read_program;
use serde_json::Value;
use support::run;

/// Torques of the PUMA over the box of its file.
fn holds(name: &str, relative_to: &str, tolerance: f64, operations: usize) {
    let generated = Path::new(env!("CARGO_MANIFEST_DIR")).join("../generated");
    let file = generated.join("certificates").join(name);
    let robot = generated.join("robots/puma560.toml");
    let (file, robot) = (file.to_str().unwrap(), robot.to_str().unwrap());
    let json: Value = serde_json::from_str(&std::fs::read_to_string(file).unwrap()).unwrap();
    let emitted = read_program(json["emitted"].as_str().unwrap()).unwrap();
    let counts = emitted.counts();
    assert!(counts.operations() <= operations, "{counts}");
    assert_eq!(json["relative_to"], relative_to);
    let parts = ["model", "sincos", "rounding"].map(|part| json[part].as_array().unwrap());
    for index in 0..6 {
        let sum: f64 = parts.iter().map(|part| part[index].as_f64().unwrap()).sum();
        assert!(sum <= tolerance, "output {index}: {sum:e}");
    }
    for (key, limits) in [
        ("position", [std::f64::consts::PI; 6]),
        ("velocity", [2.0, 2.0, 2.0, 5.0, 5.0, 5.0]),
        ("acceleration", [10.0, 10.0, 10.0, 30.0, 30.0, 30.0]),
    ] {
        for (range, limit) in json[key].as_array().unwrap().iter().zip(limits) {
            let [low, high] = [0, 1].map(|end| range[end].as_f64().unwrap());
            assert!(low <= -limit && high >= limit, "{key}: {range}");
        }
    }
    let ran = run(&["certify", file, "--robot", robot]);
    assert_eq!(ran.code, 0, "{}", ran.err);
    assert!(
        ran.out.contains("holds for `inverse_dynamics`"),
        "{}",
        ran.out
    );
}

#[test]
fn the_puma_at_a_thousandth_of_its_actuators_limits() {
    holds("puma560-actuator-1e-3.json", "actuator", 1e-3, 201);
}

#[test]
fn the_puma_at_a_hundredth_of_its_ranges() {
    holds("puma560-range-1e-2.json", "range", 1e-2, 197);
}
