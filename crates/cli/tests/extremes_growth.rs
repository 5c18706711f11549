//! Longer chains: linear inverse dynamics, code in blocks, refusals.

use dalembert_cli::extremes::cases::Change;
use dalembert_cli::measure::{Bench, Code, VECTOR};
use dalembert_codegen::workspace::{RunnableCode, Setup, parse, testing::seeded};
use dalembert_codegen::{Function, GenerateError, Request, ScalarType, generate};
use dalembert_model::robot::Robot;

use crate::robots::robot;

/// Returns a chain that repeats the Panda's joints, with right angles as they are often typed.
fn chain(n: usize) -> Robot {
    let general = Change::Typed.apply(&robot("panda")).unwrap();
    Change::Repeated(n).apply(&general).unwrap()
}

fn request(function: Function, start: &str) -> Request {
    Request {
        scalars: vec![ScalarType::F64],
        start: parse(start).unwrap(),
        ..Request::new(&[function])
    }
}

fn is_within_the_bound(robot: &Robot, emitted: &RunnableCode, states: usize) {
    let bench = Bench::new(Setup::whole(robot));
    for state in seeded(robot, states, 1) {
        let alone = [state];
        for measurement in bench.measure(&Code::emitted(emitted), &alone, &alone) {
            assert!(measurement.vector <= VECTOR, "{measurement:?}");
        }
    }
}

#[test]
fn inverse_dynamics_grows_linearly() {
    let recursion = request(Function::InverseDynamics, "newton_euler");
    let operations = |n: usize| {
        let robot = chain(n);
        let mut generated = generate(&robot, &recursion).unwrap();
        let counts = generated.functions.remove(0).counts();
        is_within_the_bound(&robot, &generated.emitted[0], 20);
        counts.operations() as f64
    };
    let [short, middle, long] = [12, 24, 48].map(operations);
    // Twice the joints, twice the increase.
    let ratio = (long - middle) / (middle - short);
    assert!((1.8..2.2).contains(&ratio), "{short} {middle} {long}");
}

#[test]
fn long_functions_come_in_blocks_and_are_right() {
    let robot = chain(12);
    let function = Function::ManipulatorEquation;
    let generated = generate(&robot, &request(function, "newton_euler")).unwrap();
    assert!(generated.functions[0].program.counts().operations() > 5000);
    let blocks = |text: &str| text.lines().filter(|l| l.ends_with(") = {")).count();
    assert!(blocks(&generated.text()) >= 6);
    is_within_the_bound(&robot, &generated.emitted[0], 3);
}

#[test]
fn what_would_explode_is_refused_with_its_size() {
    let refused = generate(&chain(60), &request(Function::DynamicCoefficients, "auto"));
    match refused {
        Err(error @ GenerateError::Refused(..)) => {
            // 60² + 60³ + 60
            assert!(error.to_string().contains("219660 numbers"), "{error}");
        }
        other => panic!("{:?}", other.map(|g| g.text().len())),
    }
}
