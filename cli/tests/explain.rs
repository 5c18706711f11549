//! `dalembert explain` as a user runs it.

mod support;

use serde_json::Value;
use support::{robot, run, temporary};

#[test]
fn the_table_and_the_reasons() {
    let ran = run(&["explain", &robot("planar2r"), "--states", "20"]);
    assert_eq!(ran.code, 0, "{}", ran.err);
    for expected in [
        "inverse_dynamics",
        "Lagrange–Euler, Table 3",
        "3140  2391",
        "unit of length",
        "to link 1, on its axis: m 1",
        "1 vanish: h_iim = 0 for m ≤ i, always",
    ] {
        assert!(ran.out.contains(expected), "{expected}\n{}", ran.out);
    }
    let again = run(&["explain", &robot("planar2r"), "--states", "20"]);
    assert_eq!(ran.out, again.out);
}

#[test]
fn as_json() {
    let ran = run(&[
        "explain",
        &robot("planar3r"),
        "--states",
        "5",
        "--outputs",
        "gravity,inverse_dynamics",
        "--json",
    ]);
    assert_eq!(ran.code, 0, "{}", ran.err);
    let json: Value = serde_json::from_str(&ran.out).unwrap();
    let functions = json["functions"].as_object().unwrap();
    assert_eq!(functions.len(), 2);
    for function in functions.values() {
        let rows = function["rows"].as_array().unwrap();
        assert!(rows.len() > 8);
        let last = rows.last().unwrap();
        assert!(last["mul"].as_u64().unwrap() < 30);
        assert!(last["normwise_u"].as_f64().unwrap() > 0.0);
        assert_eq!(function["links"].as_array().unwrap().len(), 3);
    }
    assert_eq!(json["coefficients"]["D"]["total"], 6);
}

#[test]
fn a_scene() {
    let folder = temporary("explain_scene");
    let file = folder.join("arm.toml");
    let scene = "\n[scene.still]\noutputs = [\"gravity\"]\nlock = { 1 = 0 }\n";
    let source = std::fs::read_to_string(robot("planar3r")).unwrap() + scene;
    std::fs::write(&file, source).unwrap();
    let arm = file.to_str().unwrap();
    let ran = run(&[
        "explain", arm, "--scene", "still", "--states", "5", "--json",
    ]);
    assert_eq!(ran.code, 0, "{}", ran.err);
    let json: Value = serde_json::from_str(&ran.out).unwrap();
    assert_eq!(json["scene"], "still");
    assert!(json["coefficients"].is_null());
    let rows = json["functions"]["gravity"]["rows"].as_array().unwrap();
    // Two joints are left.
    assert_eq!(rows.last().unwrap()["sincos"], 2);
    let ran = run(&["explain", arm, "--scene", "stil"]);
    assert_eq!(ran.code, 2);
    assert!(ran.err.contains("did you mean `still`?"), "{}", ran.err);
}

#[test]
fn states_have_bounds() {
    for states in ["0", "10001", "many"] {
        let ran = run(&["explain", &robot("planar2r"), "--states", states]);
        assert_eq!(ran.code, 2, "{states}");
        assert!(ran.out.is_empty());
    }
}
