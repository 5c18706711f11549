//! A certificate that would take long is refused before anything is computed.

use std::time::{Duration, Instant};

use dalembert_codegen::workspace::bound::input_box::InputBox;
use dalembert_codegen::workspace::certificate::format;
use dalembert_codegen::workspace::certificate::{Certificate, Refuted};
use dalembert_codegen::workspace::function::Function;
use dalembert_codegen::workspace::portfolio::Start;
use dalembert_codegen::workspace::program::ScalarType;
use dalembert_codegen::workspace::scene::SceneRobot;
use dalembert_model::number::{Exact, Rational};
use dalembert_model::robot::Robot;
use serde_json::{Value, json};

use crate::support;

fn honest() -> (Robot, Value) {
    let mut robot = support::robot("planar2r");
    for joint in &mut robot.joints {
        let number = |n: i64| Some(Rational::from_integer(n.into()));
        joint.limits.velocity = number(2);
        joint.limits.acceleration = number(10);
    }
    let generated = support::from(&robot, Function::InverseDynamics, Start::Auto);
    let program = &generated.functions[0].program;
    let limits = InputBox::of(&robot).unwrap();
    let scalar = ScalarType::F64;
    let claim = Certificate::make(&robot, &[], program, scalar, &limits, &[1.0; 2]);
    claim.check(&SceneRobot::whole(&robot)).unwrap();
    let json = serde_json::from_str(&claim.to_json()).unwrap();
    (robot, json)
}

/// Refused as too much work, at once.
fn too_much(robot: &Robot, claim: &Value, what: &str) {
    let begun = Instant::now();
    let said = match format::read(&claim.to_string()) {
        Err(error) => error.to_string(),
        Ok(claims) => match claims[0].check(&SceneRobot::whole(robot)) {
            Err(Refuted::Work(much)) => much.to_string(),
            other => panic!("{what}: {other:?}"),
        },
    };
    assert!(said.contains(what), "{said}");
    // Milliseconds; the rest is for a busy machine.
    assert!(begun.elapsed() < Duration::from_secs(2), "{what}");
}

fn steps(claim: &mut Value) -> &mut Vec<Value> {
    let steps = &mut claim["stages"][0]["program"]["steps"];
    steps.as_array_mut().unwrap()
}

#[test]
fn squarings_of_a_constant() {
    let (robot, mut claim) = honest();
    let before = steps(&mut claim).len();
    steps(&mut claim).push(json!("#3/10 * #3/10"));
    for squared in before + 1..before + 18 {
        steps(&mut claim).push(json!(format!("t{squared} * t{squared}")));
    }
    too_much(&robot, &claim, "bits of a constant");
}

/// The same after an edit, and as factors in front of a value.
#[test]
fn squarings_that_an_edit_brings_about() {
    let (robot, honest) = honest();
    let mut claim = honest.clone();
    let before = steps(&mut claim).len();
    steps(&mut claim).push(json!("qd[0] * qd[0]"));
    for squared in before + 1..before + 20 {
        steps(&mut claim).push(json!(format!("t{squared} * t{squared}")));
    }
    claim["stages"][0]["edits"] = json!(["qd[0] = #3/10"]);
    too_much(&robot, &claim, "bits of a constant");

    let mut claim = honest;
    let long = "7".repeat(15_001);
    let before = steps(&mut claim).len();
    steps(&mut claim).push(json!(format!("s1 * #{long}/3")));
    for step in before + 1..before + 4 {
        steps(&mut claim).push(json!(format!("t{step} * #{long}/3")));
    }
    too_much(&robot, &claim, "bits of a constant");
}

#[test]
fn polynomials_of_constant_angles() {
    let (robot, honest) = honest();
    // Twenty of these multiply out to 2^20 terms.
    let mut claim = honest.clone();
    let before = steps(&mut claim).len();
    steps(&mut claim).push(json!("#1+1*cos(1/10) * #1+1*cos(1/11)"));
    for angle in 0..20 {
        let last = before + 1 + angle;
        steps(&mut claim).push(json!(format!("t{last} * #1+1*cos(1/{})", 12 + angle)));
    }
    too_much(&robot, &claim, "of a constant");
    // A text that reading alone would multiply out is none.
    let squares: String = (10..200)
        .map(|n| format!("*sin(1/{n})*sin(1/{n})"))
        .collect();
    assert!(format!("1{squares}").parse::<Exact>().is_err());
}

#[test]
fn steps_and_stages_without_end() {
    let (robot, honest) = honest();
    let mut claim = honest.clone();
    let all = vec![json!("qd[0] * qd[0]"); 60_000];
    steps(&mut claim).extend(all);
    too_much(&robot, &claim, "50000 are the most");
    let mut claim = honest.clone();
    let stage = claim["stages"][0].clone();
    claim["stages"] = json!(vec![stage; 100]);
    too_much(&robot, &claim, "stages");
    let many = json!(vec![honest; 17]);
    let error = format::read(&many.to_string()).unwrap_err().to_string();
    assert!(error.contains("at most"), "{error}");
}
