//! `--sincos polynomial`: generated, counted, verified, certified, refused.

use std::fs;
use std::path::PathBuf;

use crate::support;
use crate::support::{good, robot, run, temporary};
use serde_json::Value;

const POLYNOMIAL: [&str; 4] = ["--outputs", "inverse_dynamics", "--sincos", "polynomial"];

fn with(subcommand: &str, more: &[&str]) -> support::Ran {
    let robot = robot("planar2r");
    run(&[&[subcommand, &robot], &POLYNOMIAL[..], more].concat())
}

#[test]
fn generated_counted_and_verified() {
    let generated = with("generate", &["--sincos-error", "1e-5"]);
    assert_eq!(generated.code, 0, "{}", generated.err);
    assert!(!generated.out.contains("libm") && generated.out.contains("| angle |"));
    assert!(generated.err.contains("trig_mul"));

    let counted = with("count", &["--sincos-error", "1e-5", "--json"]);
    let json: Value = serde_json::from_str(&counted.out).unwrap();
    let counts = &json["functions"]["inverse_dynamics"];
    assert!(counts["trig_mul"].as_u64() > Some(0) && counts["trig_add"].as_u64() > Some(0));

    let verified = with("verify", &["--sincos-error", "1e-5", "--json"]);
    assert_eq!(verified.code, 0, "{}", verified.err);
    let json: Value = serde_json::from_str(&verified.out).unwrap();
    // Two angles in two scalars.
    let sines = json["sines"].as_array().unwrap();
    assert_eq!(sines.len(), 4);
    for sine in sines {
        let (seen, proved) = (sine["seen"].as_f64(), sine["proved"].as_f64());
        assert!(seen > Some(0.0) && seen <= proved && proved < Some(1.1e-5));
    }
}

#[test]
fn what_makes_no_sense_is_refused() {
    for (error, why) in [("0", "above 0"), ("nan", "above 0"), ("1e-20", "at best")] {
        let ran = with("generate", &["--sincos-error", error]);
        assert_eq!(ran.code, 2, "{error}");
        ran.says(&[why]);
    }
    let robot = robot("planar2r");
    let ran = run(&["generate", &robot, "--sincos-error", "1e-5"]);
    assert_eq!(ran.code, 2);
    ran.says(&["add `sincos: polynomial`"]);
}

const SCENE: &str = r#"
[scene.rough]
outputs = ["inverse_dynamics"]
box = { position = [[-3, 3], [0.2, 2.8]], velocity = [2, 3], acceleration = [10, 20] }
tolerance = { value = 1e-4, relative_to = "range" }
scalar = "f64"

[scene.fine]
outputs = ["inverse_dynamics"]
box = { position = [[-3, 3], [0.2, 2.8]], velocity = [2, 3], acceleration = [10, 20] }
tolerance = { value = 1e-6, relative_to = "range" }
scalar = "f32"
"#;

/// Returns the planar arm of two joints with these scenes, in a folder of its own.
fn arm(name: &str) -> (PathBuf, String) {
    let folder = temporary(name);
    let file = folder.join("arm.toml");
    let source = fs::read_to_string(robot("planar2r")).unwrap() + SCENE;
    fs::write(&file, source).unwrap();
    let name = file.to_str().unwrap().to_owned();
    (folder, name)
}

/// Asked for, they come within the tolerance or not at all; how exact they are
/// is not asked for.
#[test]
fn a_tolerance_and_polynomials_by_name() {
    let (_, arm) = arm("sines_by_name");
    let in_scene = |scene: &str, more: &[&str]| {
        run(&[&["generate", &arm, "--scene", scene, "--sincos"], more].concat())
    };
    let ran = in_scene("rough", &["polynomial"]);
    assert_eq!(ran.code, 0, "{}", ran.err);
    assert!(!ran.out.contains("libm") && ran.err.contains("by polynomials"));
    let ran = in_scene("rough", &["libm"]);
    assert!(
        ran.code == 0 && ran.out.contains("libm::sincos"),
        "{}",
        ran.err
    );
    let ran = in_scene("fine", &["together"]);
    let called = ran.out.contains(" = dalembert_sines::sincosf(&[q[0]");
    assert!(ran.code == 0 && called, "{}", ran.err);
    let ran = in_scene("fine", &["auto"]);
    assert!(
        ran.code == 0 && ran.out.contains("libm::sincosf"),
        "{}",
        ran.err
    );
    for (scene, more, why) in [
        (
            "fine",
            &["polynomial"][..],
            "no polynomials for its sines within the tolerance",
        ),
        (
            "rough",
            &["polynomial", "--sincos-error", "1e-9"],
            "decides how exact",
        ),
        ("rough", &["polynomials"], "did you mean `polynomial`?"),
    ] {
        let ran = in_scene(scene, more);
        assert_eq!(ran.code, 2, "{more:?}");
        ran.says(&[why]);
    }
}

/// The certificate of a scene carries its polynomials, and `certify` proves
/// them from the text.
#[test]
fn certified_again_from_the_text() {
    let (folder, arm) = arm("sines");
    let arm = arm.as_str();
    let code = folder.join("arm.rs");
    good(&[
        "generate",
        arm,
        "--scene",
        "rough",
        "-o",
        code.to_str().unwrap(),
    ]);
    let mut files = fs::read_dir(&folder).unwrap().map(|f| f.unwrap().path());
    let kept = files
        .find(|f| f.extension().is_some_and(|e| e == "json"))
        .unwrap();
    let check = |name: &str, text: &str| {
        let path = folder.join(name);
        fs::write(&path, text).unwrap();
        run(&["certify", path.to_str().unwrap(), "--robot", arm])
    };
    let honest = fs::read_to_string(&kept).unwrap();
    assert!(honest.contains("\"polynomials\""));
    let ran = check("honest.json", &honest);
    assert_eq!(ran.code, 0, "{}", ran.err);

    // A coefficient of a polynomial, twice as large.
    let start = honest.find("let x").unwrap();
    let start = start + honest[start..].find("* 0.").unwrap() + "* ".len();
    let end = start + honest[start..].find(';').unwrap();
    let coefficient: f64 = honest[start..end].parse().unwrap();
    let moved = format!(
        "{}{:?}{}",
        &honest[..start],
        coefficient * 2.0,
        &honest[end..]
    );
    let ran = check("lie.json", &moved);
    assert_eq!(ran.code, 1, "{}", ran.out);
    assert!(
        ran.out.contains("refuted") || ran.out.contains("not shown"),
        "{}",
        ran.out
    );
}
