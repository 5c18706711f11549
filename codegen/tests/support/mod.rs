//! Robots for the tests of the generator.
#![allow(dead_code, reason = "each test file uses its own part")]

pub mod case;
pub mod compiled;
pub mod draw;

use std::fmt::Debug;
use std::path::Path;

use dalembert_codegen::workspace::{BOUND, Emitted, JointState, Runtime};
use dalembert_codegen::{Function, Generated, Request, ScalarType, Start, generate};
use dalembert_model::read::{self, Reading};
use dalembert_model::robot::Robot;
use serde_json::Value;

/// Returns a checked-in robot.
pub fn robot(name: &str) -> Robot {
    reading(name).robot
}

/// Returns a checked-in robot with its scenes.
pub fn reading(name: &str) -> Reading {
    reading_with(name, "")
}

/// Returns a checked-in robot with more in its file, such as scenes.
pub fn reading_with(name: &str, more: &str) -> Reading {
    let source = source(name, more);
    read::parse(&source, &read::Options::default()).unwrap_or_else(|errors| panic!("{errors}"))
}

/// Returns the text of a checked-in robot, and more.
pub fn source(name: &str, more: &str) -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../generated/robots");
    std::fs::read_to_string(folder.join(format!("{name}.toml"))).unwrap() + more
}

/// Returns the file of an arm that the tests have besides the checked-in robots.
pub fn arm_file(name: &str) -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data");
    std::fs::read_to_string(folder.join(format!("{name}.toml"))).unwrap()
}

/// Returns a robot from the text of its file.
pub fn read_robot(source: &str) -> Robot {
    read::parse(source, &read::Options::default())
        .unwrap_or_else(|errors| panic!("{errors}"))
        .robot
}

/// Returns the numbers of lists in lists.
pub fn numbers(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(list) => list.iter().flat_map(numbers).collect(),
        other => vec![other.as_f64().unwrap()],
    }
}

/// Returns a state of a file that has some of the arguments.
pub fn given(json: &Value) -> JointState {
    JointState::new(|argument| {
        let given = argument.given().and_then(|key| json.get(key));
        given.map_or_else(Vec::new, numbers)
    })
}

/// Returns one function in both scalars.
pub fn one(robot: &Robot, function: Function) -> Generated {
    let request = Request::of(&[function]);
    generate(robot, &request).unwrap_or_else(|error| panic!("{error}"))
}

/// Returns one function in f64 from one formulation.
pub fn from(robot: &Robot, function: Function, start: Start) -> Generated {
    let request = Request {
        scalars: vec![ScalarType::F64],
        start,
        ..Request::of(&[function])
    };
    generate(robot, &request).unwrap_or_else(|error| panic!("{error}"))
}

/// Holds each quantity of these against the runtime; of what errs more it says of what it is.
/// Something errs, or nothing was run.
#[track_caller]
pub fn rounds_well<'e>(
    emitted: impl IntoIterator<Item = &'e Emitted>,
    runtime: &Runtime,
    states: &[JointState],
    what: impl Debug,
) {
    for own in emitted {
        let measures = own.against_runtime(runtime, states);
        assert_eq!(measures.len(), own.function.quantities().len(), "{what:?}");
        for measure in &measures {
            let error = measure.in_units();
            assert!(error <= BOUND, "{what:?}: {error} u, {measure:?}");
        }
        let is_exact = own.function != Function::InverseDynamics || states.len() < 20;
        assert!(is_exact || measures[0].error > 0.0, "{what:?}: exact");
    }
}

/// Returns each scalar by itself.
pub fn each_scalar() -> [Vec<ScalarType>; 2] {
    ScalarType::ALL.map(|scalar| vec![scalar])
}

/// Returns all of these where the tests are optimised, so many of the first where they are
/// not: the whole takes minutes then.
pub fn dose<T>(all: &[T], first: usize) -> &[T] {
    match cfg!(debug_assertions) {
        true => all.get(..first).unwrap_or(all),
        false => all,
    }
}
