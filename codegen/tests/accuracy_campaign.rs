//! Every output of robots that nobody chose stays below 100 u, f64 and f32; what
//! inverts D below 100 u times D's condition.
//!
//! The whole campaign is for releases: `cargo test --release -p dalembert-codegen
//! --test accuracy_campaign -- --include-ignored --nocapture` prints the worst of
//! each quantity.

mod support;

use std::collections::BTreeMap;

use dalembert_codegen::function::{Function, Quantity};
use dalembert_codegen::generate::{GenerateError, Request, generate};
use dalembert_codegen::program::ScalarType;
use dalembert_codegen::states::{SEED, seeded};
use dalembert_codegen::verify::floating::{BOUND, Runtime};
use support::draw::robots;

/// The worst error of a quantity in units of u, and how many robots had it.
type Worst = BTreeMap<(Quantity, ScalarType), (f64, usize)>;

/// Outputs in turn, so many a robot, that each is met by robots of every length.
fn campaign(count: usize, each: usize, longest: usize) -> Worst {
    let mut worst = Worst::new();
    // A load is of functions that take it.
    let all = Function::ALL.into_iter();
    let outputs: Vec<Function> = all.filter(|f| *f != Function::Load).collect();
    let mut next = 0;
    for (seed, robot, _) in robots(count, 0xacc0) {
        let n = robot.joints.len();
        if n > longest {
            continue;
        }
        let runtime = Runtime::new(&robot);
        let states = seeded(&robot, 100, SEED ^ seed);
        for _ in 0..each {
            let function = outputs[next % outputs.len()];
            next += 1;
            let request = Request {
                functions: vec![function],
                ..Request::default()
            };
            let what = format!("seed {seed}, {n} joints, {function}");
            let generated = match generate(&robot, &request) {
                Ok(generated) => generated,
                // An arm whose D is singular in every state, or whose base parameters
                // cannot be written down: refused by name, which other tests are about.
                Err(GenerateError::Singular { .. } | GenerateError::Base(..)) => continue,
                Err(error) => panic!("{what}: {error}"),
            };
            for emitted in &generated.emitted {
                for measure in emitted.against_runtime(&runtime, &states) {
                    let error = measure.in_units();
                    let scalar = measure.scalar;
                    let quantity = measure.quantity;
                    assert!(
                        error <= BOUND,
                        "{what}, {quantity:?} in {scalar}: {error} u"
                    );
                    let (most, robots) = worst.entry((quantity, scalar)).or_default();
                    *most = most.max(error);
                    *robots += 1;
                }
            }
        }
    }
    worst
}

#[test]
fn short_arms_are_accurate() {
    let worst = campaign(24, 6, 3);
    assert!(worst.len() > 40, "{}", worst.len());
}

#[test]
#[ignore = "an hour in release mode"]
fn two_hundred_robots_are_accurate() {
    let worst = campaign(200, 4, 7);
    for ((quantity, scalar), (error, robots)) in &worst {
        println!("{quantity:?} {scalar}: {error:.1} u, {robots} robots");
    }
    assert!(worst.len() > 60, "{}", worst.len());
}
