//! What a plan claims of a variant's bounds is found anew by every way in: a text
//! that anybody can edit is not printed as a certificate.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use dalembert_codegen::workspace::{Refuted, keep};
use dalembert_codegen::{GenerateError, Language, Plan, Request, RobotFile, ask, generate};
use dalembert_model::number::{Exact, Rational};
use dalembert_model::read::Reading;

use crate::support;

/// Two joints that need little, so that a search is quick.
const SCENES: &str = r#"
[scene.pick]
outputs = ["inverse_dynamics"]
lock = { 1 = 0 }
box = { velocity = [1, 1, 1], acceleration = [1, 2, 2] }
tolerance = { value = 0.1, relative_to = "range" }
scalar = "f64"

[scene.push]
outputs = ["inertia"]
tolerance = { value = 0.15, relative_to = "range" }
scalar = "f64"
"#;

fn request(reading: &Reading, scene: usize) -> Request {
    Request::default().in_scene(&reading.scenes[scene])
}

/// Returns the arm, and the text of the plan that `--save-plan` would write for a scene.
fn planned(scene: usize) -> (Reading, String) {
    let mut reading = support::reading_with("planar3r", SCENES);
    if scene == 1 {
        // Rotors, beside which D can bear that something is left out.
        for joint in &mut reading.robot.joints {
            joint.armature = Rational::from_integer(1.into());
        }
    }
    let request = request(&reading, scene);
    let generated = generate(&reading.robot, &request).unwrap();
    let kept = keep(&reading.robot, &request, &generated, None);
    (reading, kept.plan.write())
}

/// Returns the plan with other numbers in the lines that begin with a word.
fn forged(plan: &str, word: &str, change: impl Fn(usize, f64) -> f64) -> String {
    let line = |line: &str| match line.strip_prefix(word) {
        Some(numbers) => {
            let numbers = numbers.split_whitespace().enumerate();
            let changed =
                numbers.map(|(place, x)| format!(" {:e}", change(place, x.parse().unwrap())));
            format!("{word}{}\n", changed.collect::<String>())
        }
        None => format!("{line}\n"),
    };
    plan.lines().map(line).collect()
}

fn generated(reading: &Reading, scene: usize, plan: &str) -> Result<String, GenerateError> {
    let request = Request {
        plan: Some(Plan::parse(plan).unwrap()),
        ..request(reading, scene)
    };
    generate(&reading.robot, &request).map(|generated| generated.text())
}

/// Each cause by itself, and D's least eigenvalue. Who claims more than can be
/// shown says what is true, and gets it printed.
#[test]
fn a_smaller_bound_than_can_be_shown_is_refused() {
    let (reading, plan) = planned(0);
    let honest = generated(&reading, 0, &plan).unwrap();
    for cause in 0..3 {
        let lie = forged(&plan, "bound", |place, x| match place == cause {
            true => 0.9 * x,
            false => x,
        });
        let refused = generated(&reading, 0, &lie);
        assert!(
            matches!(
                refused,
                Err(GenerateError::Variant(_, Refuted::Bound { .. }))
            ),
            "cause {cause}: {refused:?}"
        );
    }
    let loose = generated(&reading, 0, &forged(&plan, "bound", |_, x| 1.01 * x)).unwrap();
    assert_ne!(loose, honest);

    let (reading, plan) = planned(1);
    assert!(plan.contains("\neigenvalue "), "{plan}");
    generated(&reading, 1, &plan).unwrap();
    let refused = generated(&reading, 1, &forged(&plan, "eigenvalue", |_, x| 60.0 * x));
    assert!(
        matches!(
            refused,
            Err(GenerateError::Variant(_, Refuted::Eigenvalue { .. }))
        ),
        "{refused:?}"
    );
}

/// Returns the plan with other lines in front of the last program.
fn with_steps(plan: &str, lines: &[String]) -> String {
    let last = plan.rfind("\nnext\n").unwrap() + "\nnext\n".len();
    format!("{}{}\n{}", &plan[..last], lines.join("\n"), &plan[last..])
}

/// What would take long is refused before anything is computed.
#[test]
fn variants_that_grow_without_end() {
    let (reading, plan) = planned(0);
    let squared = |first: String| {
        let squares = (1..20).map(|step| format!("t{step} * t{step}"));
        std::iter::once(first)
            .chain(squares)
            .collect::<Vec<String>>()
    };
    let long = format!("#{}/3", "7".repeat(15_001));
    let factors = (1..5).map(|step| format!("t{step} * {long}"));
    // Twenty of these multiply out to 2^20 terms.
    let angles = (1..20).map(|step| format!("t{step} * #1+1*cos(1/{})", 11 + step));
    for (lines, what) in [
        (squared("#3/10 * #3/10".into()), "bits of a constant"),
        (
            std::iter::once(format!("s2 * {long}"))
                .chain(factors)
                .collect(),
            "bits of a constant",
        ),
        (
            std::iter::once("#1+1*cos(1/10) * #1+1*cos(1/11)".into())
                .chain(angles)
                .collect(),
            "of a constant",
        ),
        (vec!["qd[1] * qd[1]".into(); 60_000], "50000 are the most"),
    ] {
        let begun = Instant::now();
        match generated(&reading, 0, &with_steps(&plan, &lines)) {
            Err(GenerateError::Variant(_, Refuted::Work(much))) => {
                assert!(much.to_string().contains(what), "{much}");
            }
            other => panic!("{what}: {other:?}"),
        }
        // Without the generation, milliseconds; the rest is for a busy machine.
        assert!(begun.elapsed() < Duration::from_secs(20), "{what}");
    }
    let edited = squared("qd[1] * qd[1]".into());
    let edited = with_steps(&plan, &edited).replacen(
        "\nbound ",
        "\nedit qd[1] = #3/10\nnext\nqd[1] * qd[1]\nreturn t1 t1\nbound ",
        1,
    );
    let refused = generated(&reading, 0, &edited);
    assert!(
        matches!(&refused, Err(GenerateError::Variant(_, Refuted::Work(_)))),
        "{refused:?}"
    );
    // A text that reading alone would multiply out is none.
    let squares: String = (10..200)
        .map(|n| format!("*sin(1/{n})*sin(1/{n})"))
        .collect();
    assert!(format!("1{squares}").parse::<Exact>().is_err());
}

/// Another program than the edits give, and inputs that a variant may not read.
#[test]
fn variants_that_are_other_functions() {
    let (reading, plan) = planned(0);
    let last = plan.rfind("\nreturn ").unwrap();
    let end = last + 1 + plan[last + 1..].find('\n').unwrap();
    let swapped = format!("{}\nreturn t1 t2{}", &plan[..last], &plan[end..]);
    let refused = generated(&reading, 0, &swapped);
    assert!(
        matches!(refused, Err(GenerateError::Variant(_, Refuted::Step(_)))),
        "{refused:?}"
    );
    for input in ["qd[0]", "s1", "q[1]"] {
        let lines = [format!("{input} * {input}")];
        let refused = generated(&reading, 0, &with_steps(&plan, &lines));
        assert!(
            matches!(
                &refused,
                Err(GenerateError::Variant(_, Refuted::Input { .. }))
            ),
            "{input}: {refused:?}"
        );
    }
    // No bound is known of a quotient.
    let divided = with_steps(&plan, &["qd[1] / qd[2]".into()]);
    let error = Plan::parse(&divided).unwrap_err().to_string();
    assert!(error.contains("a quotient, of which no bound"), "{error}");
}

/// Returns a folder with the arm, its scenes and a plan.
fn folder(name: &str, plan: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::create_dir_all(&folder).unwrap();
    let robot = Path::new(env!("CARGO_MANIFEST_DIR")).join("../generated/robots/planar3r.toml");
    let source = fs::read_to_string(robot).unwrap();
    fs::write(folder.join("arm.toml"), format!("{source}{SCENES}")).unwrap();
    fs::write(folder.join("arm.plan"), plan).unwrap();
    folder
}

/// Macro and build script print no bound that a plan claims and nobody can show.
#[test]
fn the_bounds_of_a_plan_are_found_anew() {
    let (_, plan) = planned(0);
    let made = |plan: &str| {
        let file = RobotFile::read(&folder("plan_claims", plan).join("arm.toml")).unwrap();
        ask(
            &file,
            &"scene: pick".parse().unwrap(),
            Language::Rust,
            "arm.toml",
        )
    };
    assert!(made(&plan).is_ok());
    let problems = made(&forged(&plan, "bound", |_, x| 0.5 * x)).unwrap_err();
    assert!(
        problems[0].message.contains("what can be shown is"),
        "{problems:?}"
    );
}
