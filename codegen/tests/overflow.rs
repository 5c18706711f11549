//! What a scalar cannot hold inside the robot's limits is said at generation.

use dalembert_codegen::{Function, Request, ScalarType, generate};
use dalembert_model::read;

/// Returns the warnings for the PUMA's torques with another limit of velocity.
fn warnings(velocity: &str, scalar: ScalarType) -> Vec<String> {
    let source = include_str!("../../generated/robots/puma560.toml");
    let source = source
        .replace("velocity = 2", &format!("velocity = {velocity}"))
        .replace("velocity = 5", &format!("velocity = {velocity}"));
    let robot = read::parse(&source, &read::Options::default())
        .unwrap()
        .robot;
    let request = Request {
        scalars: vec![scalar],
        ..Request::of(&[Function::InverseDynamics])
    };
    generate(&robot, &request).unwrap().warnings
}

#[test]
fn overflow_is_flagged_for_the_scalar_that_it_threatens() {
    let flagged = |list: &[String]| list.iter().any(|w| w.contains("may overflow"));
    assert!(flagged(&warnings("1e20", ScalarType::F32)));
    assert!(!flagged(&warnings("1e20", ScalarType::F64)));
    assert!(!flagged(&warnings("2", ScalarType::F32)));
}
