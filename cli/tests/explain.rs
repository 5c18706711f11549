//! `dalembert explain` as a user runs it.

use crate::support::{good, robot, run, temporary};
use serde_json::Value;

#[test]
fn the_table_and_the_reasons() {
    let ran = good(&["explain", &robot("planar2r"), "--states", "20"]);
    for expected in [
        "inverse_dynamics",
        "Table 3, torques",
        "3140  2391",
        "unit of length",
        "to link 1, on its axis: m 1",
        "3 of 6 vanish, 1 distinct up to sign",
    ] {
        assert!(ran.out.contains(expected), "{expected}\n{}", ran.out);
    }
    let again = run(&["explain", &robot("planar2r"), "--states", "20"]);
    assert_eq!(ran.out, again.out);
}

#[test]
fn as_json() {
    let ran = good(&[
        "explain",
        &robot("planar3r"),
        "--states",
        "5",
        "--outputs",
        "gravity,inverse_dynamics",
        "--json",
    ]);
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
fn every_coefficient_of_the_puma() {
    let explain = [
        "explain",
        &robot("puma560"),
        "--states",
        "2",
        "--coefficients",
    ];
    let ran = good(&[&explain[..], &["--json"]].concat());
    let json: Value = serde_json::from_str(&ran.out).unwrap();
    let h = &json["coefficients"]["h"];
    assert_eq!([&h["total"], &h["zero"], &h["distinct"]], [126, 42, 35]);
    let entries = json["entries"].as_array().unwrap();
    let entry = |name: &str| entries.iter().find(|e| e["name"] == name).unwrap();
    assert_eq!(entry("h_222")["value"], "zero");
    assert_eq!(entry("h_211")["value"]["opposite_of"], "h_112");
    assert_eq!(entry("D_66")["value"], "constant");
    let table = json["table3"].as_array().unwrap();
    let paper = [(101_348, 77_405), (792, 662), (2963, 2209)];
    for (row, (mul, add)) in table.iter().zip(paper) {
        assert_eq!([&row["paper"]["mul"], &row["paper"]["add"]], [mul, add]);
        assert!(row["as_written"]["mul"].as_u64().unwrap() < mul);
    }
    let text = run(&explain);
    assert!(text.out.contains("−h_112"), "{}", text.out);
}

#[test]
fn a_scene() {
    let folder = temporary("explain_scene");
    let file = folder.join("arm.toml");
    let scene = "\n[scene.still]\noutputs = [\"gravity\"]\nlock = { 1 = 0 }\n";
    let source = std::fs::read_to_string(robot("planar3r")).unwrap() + scene;
    std::fs::write(&file, source).unwrap();
    let arm = file.to_str().unwrap();
    let ran = good(&[
        "explain", arm, "--scene", "still", "--states", "5", "--json",
    ]);
    let json: Value = serde_json::from_str(&ran.out).unwrap();
    assert_eq!(json["scene"], "still");
    assert!(json["coefficients"].is_null());
    let rows = json["functions"]["gravity"]["rows"].as_array().unwrap();
    // Two joints are left.
    assert_eq!(rows.last().unwrap()["sincos"], 2);
    let ran = run(&["explain", arm, "--scene", "stil"]);
    assert_eq!(ran.code, 2);
    ran.says(&["did you mean `still`?"]);
}

/// With a tolerance the last row is what `generate` writes and `count` counts:
/// its scalar, its polynomials.
#[test]
fn a_tolerance() {
    let folder = temporary("explain_tolerance");
    let file = folder.join("arm.toml");
    let scene = "\n[scene.rough]\noutputs = [\"gravity\"]\nlock = { 3 = 0 }\n\
                 tolerance = { value = 1e-2, relative_to = \"range\" }\n";
    let source = std::fs::read_to_string(robot("planar3r")).unwrap() + scene;
    std::fs::write(&file, source).unwrap();
    let arm = file.to_str().unwrap();
    let explain = ["explain", arm, "--scene", "rough", "--states", "5"];
    let ran = good(&[&explain[..], &["--json"]].concat());
    let json: Value = serde_json::from_str(&ran.out).unwrap();
    let rows = json["functions"]["gravity"]["rows"].as_array().unwrap();
    let last = rows.last().unwrap();
    assert_eq!(last["scalar"], "f32");
    let count = good(&["count", arm, "--scene", "rough", "--json"]);
    let count: Value = serde_json::from_str(&count.out).unwrap();
    let generated = good(&["generate", arm, "--scene", "rough"]);
    let counted = &count["functions"]["gravity"];
    let of = |key: &str| {
        assert_eq!(last[key], counted[key], "{key}");
        last[key].as_u64().unwrap()
    };
    assert!(of("trig_mul") > 0);
    let line = format!(
        "{} mul, {} add, {} sincos, {} trig_mul, {} trig_add.",
        of("mul"),
        of("add"),
        of("sincos"),
        of("trig_mul"),
        of("trig_add")
    );
    assert!(generated.out.contains(&line), "{line}\n{}", generated.out);
    let ran = run(&explain);
    assert_eq!(ran.out.matches("what is generated").count(), 1);
    assert!(
        ran.out
            .contains("what the tolerance admits, in f32: what is generated"),
        "{}",
        ran.out
    );
}

#[test]
fn states_have_bounds() {
    for states in ["0", "10001", "many"] {
        let ran = run(&["explain", &robot("planar2r"), "--states", states]);
        assert_eq!(ran.code, 2, "{states}");
        assert!(ran.out.is_empty());
    }
}
