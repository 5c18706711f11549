//! Longer chains: linear inverse dynamics, code in blocks, refusals.

use crate::extremes_support::chain::chain;
use dalembert_codegen::workspace::{Reference, SceneRobot, parse, seeded};
use dalembert_codegen::{Function, GenerateError, Request, ScalarType, generate};
use dalembert_report::stress::deviation::Measure;
use dalembert_report::stress::subject::Code;

fn request(function: Function, start: &str) -> Request {
    Request {
        scalars: vec![ScalarType::F64],
        start: parse(start).unwrap(),
        ..Request::of(&[function])
    }
}

#[test]
fn inverse_dynamics_grows_linearly() {
    let recursion = request(Function::InverseDynamics, "newton_euler");
    let operations = |n: usize| {
        let robot = chain(n, n as u64);
        let mut generated = generate(&robot, &recursion).unwrap();
        let counts = generated.functions.remove(0).counts();
        let code = Code::Emitted(generated.emitted);
        let reference = Reference::new(&SceneRobot::whole(&robot));
        let measure = Measure::new(&robot, ScalarType::F64, Vec::new());
        for state in seeded(&robot, 20, 1) {
            let found = code.run(Function::InverseDynamics, &state).unwrap();
            let truth = reference.run(Function::InverseDynamics, &state);
            let error = measure.of(&found, &truth).normwise;
            assert!(error <= 100.0, "{n} joints: {error} u");
        }
        counts.operations() as f64
    };
    let [short, middle, long] = [12, 24, 48].map(operations);
    // Twice the joints, twice the increase.
    let ratio = (long - middle) / (middle - short);
    assert!((1.8..2.2).contains(&ratio), "{short} {middle} {long}");
}

#[test]
fn long_functions_come_in_blocks_and_are_right() {
    let robot = chain(12, 12);
    let function = Function::ManipulatorEquation;
    let generated = generate(&robot, &request(function, "newton_euler")).unwrap();
    assert!(generated.functions[0].program.steps.len() > 5000);
    let blocks = |text: &str| text.lines().filter(|l| l.ends_with(") = {")).count();
    assert!(blocks(&generated.text()) >= 6);
    let code = Code::Emitted(generated.emitted);
    let measure = Measure::new(&robot, ScalarType::F64, Vec::new());
    let reference = Reference::new(&SceneRobot::whole(&robot));
    for state in seeded(&robot, 3, 8) {
        let found = code.run(function, &state).unwrap();
        let expected = reference.run(function, &state);
        let n = robot.joints.len();
        for range in [0..n * n, n * n..n * n + n, n * n + n..n * n + 2 * n] {
            let error = measure.of(&found[range.clone()], &expected[range]);
            assert!(error.normwise <= 100.0, "{error:?}");
        }
    }
}

#[test]
fn what_would_explode_is_refused_with_its_size() {
    let refused = generate(
        &chain(60, 60),
        &request(Function::DynamicCoefficients, "auto"),
    );
    match refused {
        Err(error @ GenerateError::TooLarge { .. }) => {
            // 60² + 60³ + 60
            assert!(error.to_string().contains("219660 numbers"), "{error}");
        }
        other => panic!("{:?}", other.map(|g| g.text().len())),
    }
}
