//! The checked-in certificates hold. Their operations are bars, which only ever go
//! down; the searches took minutes.

use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::support::good;

/// Torques of the PUMA over the box of its file.
fn holds(name: &str, relative_to: &str, tolerance: f64, operations: usize) {
    let generated = Path::new(env!("CARGO_MANIFEST_DIR")).join("../generated");
    let file = generated.join("certificates").join(name);
    let robot = generated.join("robots/puma560.toml");
    let (file, robot) = (file.to_str().unwrap(), robot.to_str().unwrap());
    let certificate: Value = serde_json::from_str(&fs::read_to_string(file).unwrap()).unwrap();
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
