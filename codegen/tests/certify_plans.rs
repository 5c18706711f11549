//! Variants that a plan kept: a text that anybody can edit, whose bounds are found anew.

use std::time::{Duration, Instant};

use dalembert_codegen::workspace::{Refuted, keep};
use dalembert_codegen::{GenerateError, Plan, Request, generate};
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

fn generated(reading: &Reading, scene: usize, plan: &str) -> Result<String, GenerateError> {
    let request = Request {
        plan: Some(Plan::parse(plan).unwrap()),
        ..request(reading, scene)
    };
    generate(&reading.robot, &request).map(|generated| generated.text())
}

/// A variant of a plan is the one that was found, in every byte; one that is not within the tolerance
/// is searched for anew.
#[test]
fn bounds_are_found_anew() {
    for scene in 0..2 {
        let (reading, plan) = planned(scene);
        let found = generate(&reading.robot, &request(&reading, scene)).unwrap();
        assert_eq!(generated(&reading, scene, &plan).unwrap(), found.text());
        let last = plan.rfind("\nreturn ").unwrap();
        let end = last + 1 + plan[last + 1..].find('\n').unwrap();
        let count = found.functions[0].program.dag.outputs.len();
        let other = format!(
            "{}\nreturn{}{}",
            &plan[..last],
            " #0".repeat(count),
            &plan[end..]
        );
        assert_eq!(generated(&reading, scene, &other).unwrap(), found.text());
    }
}

/// Returns the plan with other lines in front of the last program.
fn with_steps(plan: &str, lines: &[String]) -> String {
    let last = plan.rfind("\nleft ").or(plan.rfind("\nedited")).unwrap();
    let last = last + plan[last + 1..].find('\n').unwrap() + 2;
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
    // A text that reading alone would multiply out is none.
    let squares: String = (10..200)
        .map(|n| format!("*sin(1/{n})*sin(1/{n})"))
        .collect();
    assert!(format!("1{squares}").parse::<Exact>().is_err());
}

/// Inputs that a variant may not read, and words that would end a comment.
#[test]
fn variants_that_are_other_functions() {
    let (reading, plan) = planned(0);
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
    let hidden = with_steps(&plan, &["left 1 0 */ evil();".into()]);
    let error = Plan::parse(&hidden).unwrap_err().to_string();
    assert!(error.contains("expected what was left out"), "{error}");
}
