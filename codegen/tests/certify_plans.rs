//! Variants that a plan kept: a text that anybody can edit, whose bounds are found anew.

use std::time::{Duration, Instant};

use dalembert_checker::claim::{Claim, Claimed};
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
        let other = changed(&plan, |own| {
            let count = own.returns.split(' ').count();
            own.returns = vec!["#0"; count].join(" ");
        });
        assert_eq!(generated(&reading, scene, &other).unwrap(), found.text());
    }
}

/// Returns the plan with another program, or with other words about it.
fn changed(plan: &str, change: impl FnOnce(&mut Claimed)) -> String {
    let mut claim = Claim::read(plan).unwrap();
    assert!(claim.functions[0].tolerated.is_some());
    change(&mut claim.functions[0]);
    claim.write()
}

/// Returns the plan with other operations in front of the variant's: `$0` is the first of these
/// constants.
fn with_steps(plan: &str, constants: &[&str], steps: &[String]) -> String {
    let mut claim = Claim::read(plan).unwrap();
    let first = claim.constants.len();
    claim
        .constants
        .extend(constants.iter().map(|&own| own.to_owned()));
    let mut words = steps.join(" ");
    for place in 0..constants.len() {
        words = words.replace(&format!("${place} "), &format!("#{} ", first + place));
        words = words.replace(&format!("${place}*"), &format!("#{}*", first + place));
    }
    let own = &mut claim.functions[0].steps;
    *own = format!("{words}{own}");
    claim.write()
}

/// What would take long is refused before anything is computed.
#[test]
fn variants_that_grow_without_end() {
    let (reading, plan) = planned(0);
    let squared = |first: &str| {
        let squares = (1..20).map(|step| format!("t{step}*t{step} "));
        let all = std::iter::once(first.to_owned()).chain(squares);
        all.collect::<Vec<String>>()
    };
    let long = format!("{}/3", "7".repeat(15_001));
    let factors = (1..5).map(|step| format!("t{step}*$0 "));
    // Twenty of these multiply out to 2^20 terms.
    let angles: Vec<String> = (10..30).map(|n| format!("1+1*cos(1/{n})")).collect();
    let angles: Vec<&str> = angles.iter().map(String::as_str).collect();
    let products = (2..20).map(|n| format!("t{}*${n} ", n - 1));
    let first = |first: &str| std::iter::once(first.to_owned());
    for (constants, steps, what) in [
        (vec!["3/10"], squared("$0*$0 "), "bits of a constant"),
        (
            vec![&*long],
            first("s2*$0 ").chain(factors).collect(),
            "bits of a constant",
        ),
        (
            angles,
            first("$0*$1 ").chain(products).collect(),
            "of a constant",
        ),
        (
            vec![],
            vec!["qd[1]*qd[1] ".into(); 60_000],
            "50000 are the most",
        ),
    ] {
        let begun = Instant::now();
        match generated(&reading, 0, &with_steps(&plan, &constants, &steps)) {
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
        let steps = [format!("{input}*{input} ")];
        let refused = generated(&reading, 0, &with_steps(&plan, &[], &steps));
        assert!(
            matches!(
                &refused,
                Err(GenerateError::Variant(_, Refuted::Input { .. }))
            ),
            "{input}: {refused:?}"
        );
    }
    // No bound is known of a quotient.
    let divided = with_steps(&plan, &[], &["qd[1]/qd[2] ".into()]);
    let error = Plan::parse(&divided).unwrap_err().to_string();
    assert!(error.contains("a quotient, of which no bound"), "{error}");
    let hidden = changed(&plan, |own| {
        let planned = own.planned.as_mut().unwrap();
        planned.left_out.push(("*/ evil();".into(), 1, 0));
    });
    let error = Plan::parse(&hidden).unwrap_err().to_string();
    assert!(error.contains("what was left out"), "{error}");
}
