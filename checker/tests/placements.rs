//! Joints that are placed by frames, tilted rows, bases and frames of payloads: each a file
//! that was generated, and the same with a planted fault in it or in the robot file.

use dalembert_checker::exact::check;

use crate::support::file;

fn is_shown(source: &str, robot: &str, scene: Option<&str>) -> bool {
    check(source, robot, scene).unwrap().is_shown()
}

/// Asserts that a file is shown, and that it is not with one word of it, or of the robot file,
/// changed.
fn case(
    robot: &str,
    source: &str,
    scene: Option<&str>,
    faults: &[[&str; 2]],
    robots: &[[&str; 2]],
) {
    let robot = file(robot);
    let source = file(&format!("checker/tests/data/generated/{source}.rs"));
    let report = check(&source, &robot, scene).unwrap();
    assert!(report.is_shown(), "{report:?}");
    let code = source.find("let t1 = ").unwrap();
    for [from, to] in faults {
        assert!(source[code..].contains(from), "{from}");
        let changed = source[code..].replacen(from, to, 1);
        let changed = format!("{}{changed}", &source[..code]);
        assert!(!is_shown(&changed, &robot, scene), "{from}");
    }
    for [from, to] in robots {
        assert!(robot.contains(from), "{from}");
        let changed = robot.replacen(from, to, 1);
        assert!(!is_shown(&source, &changed, scene), "{to}");
    }
}

#[test]
fn rows_with_a_second_twist_on_a_base_that_is_turned() {
    case(
        "checker/tests/data/tilted.toml",
        "tilted",
        None,
        &[[" + ", " - "], [" * ", " + "]],
        &[
            ["beta = -0.3", "beta = -0.30001"],
            ["rpy = [\"pi/2\", 0, 0.3]", "rpy = [\"pi/2\", 0.3, 0]"],
            ["alpha = 0.001", "alpha = 0.002"],
        ],
    );
}

#[test]
fn joints_that_are_placed() {
    case(
        "model/tests/data/scara_placed.toml",
        "scara_placed",
        None,
        &[[" - ", " + "]],
        &[
            ["axis = [0, 0, -1]", "axis = [0, 0, 1]"],
            ["xyz = [0.225, 0, 0]", "xyz = [0.2250001, 0, 0]"],
        ],
    );
}

#[test]
fn axes_that_are_oblique() {
    case(
        "checker/tests/data/oblique.toml",
        "oblique",
        None,
        &[[" - ", " + "], ["c1", "s1"]],
        &[
            ["axis = [1, -2, 2]", "axis = [1, -2, 2.00001]"],
            ["axis = [1, -2, 2]", "axis = [1, 2, 2]"],
            ["rpy = [0.4, -0.2,", "rpy = [-0.2, 0.4,"],
            ["rpy = [0, \"pi/6\", 0]", "rpy = [0, 0, \"pi/6\"]"],
        ],
    );
}

#[test]
fn payloads_in_a_frame_of_their_own() {
    case(
        "checker/tests/data/oblique.toml",
        "oblique-carry",
        Some("carry"),
        &[[" - ", " + "]],
        &[
            ["xyz = [0, 0, 0.05]", "xyz = [0, 0, -0.05]"],
            ["rpy = [0.2, 0, \"pi/2\"]", "rpy = [0.2, 0, 0]"],
        ],
    );
}

/// Rows beside placements, and axes without direction.
#[test]
fn joints_that_are_neither() {
    let robot = file("checker/tests/data/oblique.toml");
    let source = file("checker/tests/data/generated/oblique.rs");
    for (from, to) in [
        ("axis = [0, -1, 0]", "axis = [0, 0, 0]"),
        ("axis = [0, -1, 0]", ""),
        ("axis = [0, -1, 0]", "axis = [0, -1, nan]"),
        ("name =", "convention = \"standard\"\nname ="),
        (
            "placement = { xyz = [0, 0.25, 0.02], rpy = [0, 0.5, 0] }",
            "",
        ),
    ] {
        let changed = robot.replacen(from, to, 1);
        let fault = check(&source, &changed, None).unwrap_err().to_string();
        assert!(fault.starts_with("robot file"), "{to}: {fault}");
    }
}

/// Coulomb friction is in torques, of which no bound is known with it, and in nothing else.
#[test]
fn joints_with_coulomb_friction() {
    let robot = file("model/tests/data/coulomb.toml");
    let source = file("checker/tests/data/generated/coulomb.rs");
    let report = check(&source, &robot, None).unwrap();
    for line in &report.lines {
        let is_shown = line.result.as_ref().is_ok_and(|found| found.is_shown());
        assert_eq!(is_shown, line.name != "inverse_dynamics", "{report:?}");
    }
    // Not even if the text has none.
    let head =
        "pub fn inverse_dynamics(q: &[f64; 3], qd: &[f64; 3], qdd: &[f64; 3]) -> [f64; 3] {\n";
    let plain = format!("pub mod coulomb {{\n{head}    [0.0, 0.0, 0.0]\n}}\n}}\n");
    let report = check(&plain, &robot, None).unwrap();
    let fault = report.lines[0].result.as_ref().unwrap_err().to_string();
    assert!(fault.contains("Coulomb"), "{fault}");
}
