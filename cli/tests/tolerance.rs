//! Scenes with a tolerance, as a user runs them: code, certificate, plan, and what is refused.

use std::fs;

use serde_json::Value;

use crate::support::planar::{arm, json, path};
use crate::support::{good, robot, run, temporary};

/// The scene's code, its certificate beside it, and both again from a plan.
#[test]
fn a_scene_with_a_tolerance() {
    let (folder, arm) = arm("scene_tolerance");
    let output = path(&folder, "pick.rs");
    let generate = ["generate", &arm, "--scene", "pick", "-o", &output];
    let ran = good(&generate);
    for part in [
        "left out, and what putting it back costs",
        "certified",
        "pick.certificate.json",
    ] {
        assert!(ran.err.contains(part), "{part}: {}", ran.err);
    }
    let text = fs::read_to_string(&output).unwrap();
    for part in [
        "; scene: pick\n",
        "T of an output is a size that it attains in the box",
        "| output | T | E | left out | sin/cos | rounding |",
        "| joint | q | q̇ | q̈ |",
        "bring back:",
    ] {
        assert!(text.contains(part), "{part}\n{text}");
    }
    let file = path(&folder, "pick.certificate.json");
    let certificate = json(&file);
    assert_eq!(certificate["scene"], "pick");
    let total = certificate["total"].as_array().unwrap();
    assert_eq!(total.len(), 2);
    assert!(total.iter().all(|e| e.as_f64().unwrap() <= 0.1));
    assert!(certificate["model"][0].as_f64().unwrap() > 1e-6);

    let ran = good(&["certify", &file, "--robot", &arm]);
    ran.prints(&["in scene pick"]);
    assert_eq!(ran.out.matches("  E holds\n").count(), 2, "{}", ran.out);
    let verified = good(&["verify", &arm, "--scene", "pick", "--json"]);
    let verified: Value = serde_json::from_str(&verified.out).unwrap();
    assert_eq!(verified["certificates"][0]["passed"], true);

    // The plan has the variant and its bounds: the same bytes, nothing searched.
    good(&[&generate[..], &["--save-plan"]].concat());
    let plan = fs::read_to_string(folder.join("arm.plan")).unwrap();
    assert!(
        plan.contains("\nedited\nedit ") && plan.contains("\nbound "),
        "{plan}"
    );
    good(&["renew", &output, "--check"]);
    // Bounds are found anew.
    let low = plan.replacen("\nbound ", "\nbound 1e-9 0 0\n# ", 1);
    fs::write(folder.join("arm.plan"), low).unwrap();
    let ran = run(&generate);
    assert_ne!(ran.code, 0, "{}", ran.err);
    ran.says(&["what can be shown is"]);
}

/// The first torque of an arm that stands upright needs nothing against gravity:
/// T is zero, which the code meets, since zero is what it returns.
#[test]
fn an_output_that_is_zero_is_exact() {
    let folder = temporary("upright");
    let file = path(&folder, "arm.toml");
    let puma = fs::read_to_string(robot("puma560")).unwrap();
    let scene = r#"
[scene.hold]
outputs = ["gravity"]
tolerance = { value = 0.1, relative_to = "range" }
"#;
    fs::write(&file, format!("{puma}{scene}")).unwrap();
    let certificate = path(&folder, "hold.json");
    let generate = ["generate", &file, "--scene", "hold", "--certificate"];
    good(&[&generate[..], &[&certificate]].concat());
    let claimed = json(&certificate);
    assert_eq!(
        (&claimed["scale"][0], &claimed["total"][0]),
        (&0.0.into(), &0.0.into())
    );
    // Nor does it keep the others from giving way.
    assert!(claimed["model"][1].as_f64().unwrap() > 1e-6);
    good(&["certify", &certificate, "--robot", &file]);
}

#[test]
fn what_cannot_be_met_or_certified_is_said() {
    let (folder, arm) = arm("refused");
    let ran = run(&["generate", &arm, "--scene", "exactly"]);
    assert_eq!(ran.code, 2);
    assert!(
        ran.err
            .contains("no variant in f64 can be certified to keep c_1 within 1.0e-17"),
        "{}",
        ran.err
    );
    assert!(ran.out.is_empty());

    // Nobody chose a scalar: the narrow one is exact enough.
    let ran = good(&["generate", &arm, "--scene", "any"]);
    assert!(
        ran.out.contains("3 joints, in `f32`") && !ran.out.contains("f64"),
        "{}",
        ran.out
    );

    let file = path(&folder, "none.json");
    let ran = run(&[
        "generate",
        &arm,
        "--outputs",
        "gravity",
        "--certificate",
        &file,
    ]);
    assert!(
        ran.code == 2 && ran.err.contains("nothing to certify"),
        "{}",
        ran.err
    );
}

/// Every mistake in a scene ends with its line, whichever subcommand reads it.
#[test]
fn bad_scenes_name_the_line() {
    let folder = temporary("bad_scenes");
    let file = folder.join("arm.toml");
    let planar = fs::read_to_string(robot("planar3r")).unwrap();
    let name = file.to_str().unwrap();
    let good = r#"tolerance = { value = 0.1, relative_to = "range" }"#;
    for (scene, words) in [
        (
            "box = { position = [[1, 1], [0, 1], [0, 1]] }",
            "the range is empty",
        ),
        ("box = { velocity = [1, -1, 1] }", "the range is empty"),
        (
            "box = { velocity = [1, 1] }",
            "2 entries, but the robot has 3 joints",
        ),
        ("joints = [4]", "there is no joint `4`"),
        ("lock = { elbw = 0 }", "did you mean `elbow`?"),
        ("lock = { 2 = 4 }", "locked outside its limits"),
        (
            r#"tolerance = { value = 0, relative_to = "range" }"#,
            "above zero",
        ),
        (
            r#"tolerance = { value = -1e-3, relative_to = "range" }"#,
            "above zero",
        ),
        (
            r#"tolerance = { value = [1, 1], relative_to = "range" }"#,
            "2 tolerances",
        ),
        ("tolerance = { value = 1e-3 }", "has no `relative_to`"),
        (good, "needs the range of the velocity of joint 1"),
        (
            r#"tolerance = { value = 0.1, relative_to = "actuator" }"#,
            "needs the torque limit of joint 1",
        ),
    ] {
        let source = format!("{planar}\n[scene.bad]\n{scene}\n");
        fs::write(&file, &source).unwrap();
        let line = source.lines().count();
        for subcommand in ["generate", "tradeoff"] {
            let ran = run(&[subcommand, name, "--scene", "bad"]);
            assert_eq!(ran.code, 2, "{scene}: {}", ran.err);
            assert!(ran.err.contains(words), "{scene}: {}", ran.err);
            assert!(
                ran.err.contains(&format!("arm.toml:{line}:")),
                "{scene}: {}",
                ran.err
            );
        }
    }
}
