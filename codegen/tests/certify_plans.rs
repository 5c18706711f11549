//! Variants that a plan kept: a text that anybody can edit, whose bounds are found anew.

use std::time::{Duration, Instant};

use dalembert_checker::claim::{Claim, FunctionClaim};
use dalembert_codegen::{GenerateError, GeneratedCode, Plan, Request, generate};
use dalembert_model::number::{Exact, Rational};

use crate::support::{Case, says, variants};

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

fn planned(scene: &str) -> (Case, GeneratedCode, String) {
    let mut case = Case::new("planar3r", SCENES, &format!("scene: {scene}"));
    if scene == "push" {
        // Rotors, beside which D can bear that something is left out.
        for joint in &mut case.reading.robot.joints {
            joint.armature = Rational::from_integer(1.into());
        }
    }
    let generated = case.generated();
    let plan = case.plan(&generated).write();
    (case, generated, plan)
}

fn by(case: &Case, plan: &str) -> Result<GeneratedCode, GenerateError> {
    let request = Request {
        plan: Some(Plan::parse(plan).unwrap()),
        ..case.request.clone()
    };
    generate(case.robot(), &request)
}

#[test]
fn bounds_are_found_anew() {
    for scene in ["pick", "push"] {
        let (case, original, plan) = planned(scene);
        let again = by(&case, &plan).unwrap();
        assert!(again.functions[0].planned);
        assert_eq!(again.text(), original.text());
        assert_eq!(variants(&again), variants(&original));
        let other = changed(&plan, |claim| {
            let count = claim.returns.split(' ').count();
            claim.returns = vec!["#0"; count].join(" ");
        });
        assert_eq!(by(&case, &other).unwrap().text(), original.text());
    }
}

fn changed(plan: &str, change: impl FnOnce(&mut FunctionClaim)) -> String {
    let mut claim = Claim::read(plan).unwrap();
    assert!(claim.functions[0].tolerated.is_some());
    change(&mut claim.functions[0]);
    claim.write()
}

/// `$0` is the first of these constants.
fn with_steps(plan: &str, constants: &[String], steps: &[String]) -> String {
    let mut claim = Claim::read(plan).unwrap();
    let first = claim.constants.len();
    claim.constants.extend(constants.iter().cloned());
    let mut words = steps.join(" ") + " ";
    // From the last on: `$1` begins `$10`, too.
    for place in (0..constants.len()).rev() {
        words = words.replace(&format!("${place}"), &format!("#{}", first + place));
    }
    claim.functions[0].steps.insert_str(0, &words);
    claim.write()
}

#[test]
fn variants_that_grow_without_end() {
    let (case, original, plan) = planned("pick");
    let first = |first: &str, rest: Vec<String>| [vec![first.to_owned()], rest].concat();
    let squares = (1..20).map(|step| format!("t{step}*t{step}")).collect();
    let factors = (1..5).map(|step| format!("t{step}*$0")).collect();
    // Twenty of these multiply out to 2^20 terms.
    let angles: Vec<String> = (10..30).map(|n| format!("1+1*cos(1/{n})")).collect();
    let products = (2..20).map(|n| format!("t{}*${n}", n - 1)).collect();
    let long = format!("{}/3", "7".repeat(15_001));
    for (constants, steps) in [
        (vec!["3/10".into()], first("$0*$0", squares)),
        (vec![long], first("s2*$0", factors)),
        (angles, first("$0*$1", products)),
        (vec![], vec!["qd[1]*qd[1]".into(); 60_000]),
    ] {
        let begun = Instant::now();
        // A program that the checker does not show gives way to another search.
        let again = by(&case, &with_steps(&plan, &constants, &steps)).unwrap();
        assert_eq!(again.text(), original.text());
        assert!(begun.elapsed() < Duration::from_secs(20), "{}", steps[0]);
    }
    // A text that reading alone would multiply out is none.
    let square = |n| format!("*sin(1/{n})*sin(1/{n})");
    let squares: String = (10..200).map(square).collect();
    assert!(format!("1{squares}").parse::<Exact>().is_err());
}

#[test]
fn variants_that_are_other_functions() {
    let (case, _, plan) = planned("pick");
    for input in ["qd[0]", "s1", "q[1]"] {
        let steps = [format!("{input}*{input}")];
        let refused = by(&case, &with_steps(&plan, &[], &steps)).unwrap_err();
        assert!(matches!(refused, GenerateError::Variant(..)));
        says(&refused.to_string(), " reads `");
    }
    // No bound is known of a quotient.
    let divided = with_steps(&plan, &[], &["qd[1]/qd[2]".into()]);
    let error = Plan::parse(&divided).unwrap_err().to_string();
    says(&error, "a quotient, for which no bound");
}
