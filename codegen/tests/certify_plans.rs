//! What a plan claims of a variant's bounds is found anew by every way in: a text
//! that anybody can edit is not printed as a certificate.

use std::fs;
use std::path::{Path, PathBuf};

use dalembert_codegen::workspace::certificate::Refuted;
use dalembert_codegen::workspace::clauses::expand;
use dalembert_codegen::workspace::generate::keep::keep;
use dalembert_codegen::workspace::generate::{GenerateError, Request, generate};
use dalembert_codegen::workspace::plan::Plan;
use dalembert_model::number::Rational;
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

/// The arm, and the text of the plan that `--save-plan` would write for a scene.
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

/// The plan with other numbers in the lines that begin with a word.
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
    generate(&reading.robot, &request).map(|generated| generated.text)
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

/// A folder with the arm, its scenes and a plan.
fn folder(name: &str, plan: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::create_dir_all(&folder).unwrap();
    let robot = Path::new(env!("CARGO_MANIFEST_DIR")).join("../generated/robots/planar3r.toml");
    let source = fs::read_to_string(robot).unwrap();
    fs::write(folder.join("arm.toml"), format!("{source}{SCENES}")).unwrap();
    fs::write(folder.join("arm.plan"), plan).unwrap();
    folder
}

/// `dynamics!` prints no bound that a plan claims and nobody can show.
#[test]
fn the_macro_finds_the_bounds_of_a_plan_anew() {
    let (_, plan) = planned(0);
    let expanded = |plan: &str| {
        let folder = folder("plan_claims", plan);
        let invocation = "mod arm = \"arm.toml\"; scene: pick;".parse().unwrap();
        expand(invocation, &folder).to_string()
    };
    let text = expanded(&plan);
    assert!(!text.contains("compile_error"), "{text}");
    let text = expanded(&forged(&plan, "bound", |_, x| 0.5 * x));
    assert!(
        text.contains("compile_error") && text.contains("what can be shown is"),
        "{text}"
    );
}
