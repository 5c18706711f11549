//! `dalembert explain` as a user runs it.

use crate::support::{arm, good, robot, run, temporary};
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

/// Returns the lines of generated code that begin with a name, by their numbers.
fn constants(arm: &str) -> Vec<(usize, String)> {
    let ran = good(&["generate", arm, "--outputs", "inverse_dynamics"]);
    let lines = ran.out.lines().enumerate();
    let lines = lines.filter(|(_, line)| line.trim().starts_with("let t"));
    lines
        .map(|(index, line)| (index + 1, line.trim().to_owned()))
        .collect()
}

/// What is traced of a number are the lines that change when it does, and the results that
/// golden formulas make depend on it.
#[test]
fn traced_lines_are_those_that_change() {
    let (folder, arm) = arm("explain_trace", "puma560", "");
    let before = constants(&arm);
    for (number, from, to, results) in [
        ("joint2.mass", "mass = 17.4\n", "mass = 17.5\n", 2),
        ("shoulder.com.x", "com = [-0.3638, ", "com = [-0.3639, ", 2),
        ("joint3.inertia.yy", "0.086, 0.0125", "0.087, 0.0125", 2),
    ] {
        let ran = good(&["explain", &arm, "--trace", number, "--json"]);
        let json: Value = serde_json::from_str(&ran.out).unwrap();
        let function = &json["functions"][0];
        assert_eq!(
            function["results_that_change"].as_array().unwrap().len(),
            results
        );
        let followers = function["constants"].as_array().unwrap().iter();
        let lines = followers.flat_map(|own| own["lines"].as_array().unwrap());
        let mut traced: Vec<(usize, String)> = lines
            .map(|line| {
                let number = line["line"].as_u64().unwrap() as usize;
                (number, line["code"].as_str().unwrap().to_owned())
            })
            .collect();
        traced.sort();
        let robot = std::fs::read_to_string(&arm).unwrap();
        assert!(robot.contains(from), "{number}");
        let other = folder.join("other.toml");
        std::fs::write(&other, robot.replacen(from, to, 1)).unwrap();
        let after = constants(other.to_str().unwrap());
        assert_eq!(before.len(), after.len(), "{number}: another form");
        let changed = before
            .iter()
            .zip(&after)
            .filter(|(own, other)| own != other);
        let changed: Vec<(usize, String)> = changed.map(|(own, _)| own.clone()).collect();
        assert_eq!(traced, changed, "{number}");
    }
}

/// m₂ l₁ c₂ = 0.5 in the sine and the cosine of q₂, I₂ + m₂ c₂² = 1/3: with another centre of mass
/// the search finds other operations, and these constants are the fewest that could follow it.
#[test]
fn constants_of_the_planar_arm_by_hand() {
    let ran = good(&[
        "explain",
        &robot("planar2r"),
        "--trace",
        "elbow.com.x",
        "--json",
    ]);
    let json: Value = serde_json::from_str(&ran.out).unwrap();
    let function = &json["functions"][0];
    let constants = function["constants"].as_array().unwrap().iter();
    let constants: Vec<&str> = constants
        .map(|own| own["constant"].as_str().unwrap())
        .collect();
    assert_eq!(
        constants,
        ["0.5", "0.3333333333333333", "0.5"],
        "{}",
        ran.out
    );
}

#[test]
fn what_reaches_nothing_and_what_gives_the_form() {
    let trace = |name: &str| run(&["explain", &robot("puma560"), "--trace", name]);
    for (name, said) in [
        ("joint1.mass", "no result changes with it"),
        (
            "joint1.viscous",
            "the code has its form because of this very value",
        ),
        ("joint2.inertia.zz", "constants that follow it: 1,"),
    ] {
        let ran = trace(name);
        assert_eq!(ran.code, 0, "{}", ran.err);
        assert!(ran.out.contains(said), "{name}: {}", ran.out);
    }
    for (name, said) in [
        (
            "joint9.mass",
            "there is no joint `joint9`: expected joint1 to joint6",
        ),
        ("joint2.colour", "there is no `colour` of joint 2"),
        ("gravity.w", "expected x, y or z"),
        ("mass", "expected JOINT.KEY or gravity.AXIS"),
    ] {
        let ran = trace(name);
        assert_eq!(ran.code, 2, "{name}");
        assert!(ran.err.contains(said) && ran.out.is_empty(), "{}", ran.err);
    }
    let tolerance = "\n[scene.rough]\noutputs = [\"gravity\"]\ntolerance = { value = 1e-3, relative_to = \"range\" }\n";
    let (_, arm) = arm("explain_trace_tolerance", "planar2r", tolerance);
    let ran = run(&[
        "explain",
        &arm,
        "--scene",
        "rough",
        "--trace",
        "joint2.mass",
    ]);
    assert_eq!(ran.code, 2, "{}", ran.out);
    ran.says(&["for the scene's tolerance"]);
}
