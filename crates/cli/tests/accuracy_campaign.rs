//! The error of every output of random robots, f64 and f32, against 76 digits: below
//! 100 u (unit roundoff), or 100 u times D's condition number if the output inverts D.
//!
//! The whole campaign runs by hand: `cargo test --release -p dalembert-cli --test all --
//! by_hand_two_hundred --ignored --nocapture` prints the worst of each quantity.

use std::collections::BTreeMap;
use std::ops::Range;

use crate::robots::daily_and_campaign;
use crate::robots::draw::robots;
use dalembert_cli::measure::{Bench, Code, VECTOR};
use dalembert_codegen::workspace::{Quantity, SEED, Setup, testing::seeded};
use dalembert_codegen::{Function, GenerateError, Request, ScalarType, generate};

const STATES: usize = 30;

/// The worst error of a quantity in units of u, and how many robots had it.
type Worst = BTreeMap<(Quantity, ScalarType), (f64, usize)>;

/// Runs `count` outputs per robot in turn, so that each output meets robots of every length.
fn campaign(places: Range<usize>, count: usize, longest: usize) -> Worst {
    let mut worst = Worst::new();
    let functions = Function::ALL.into_iter();
    let fixed = functions.filter(|function| function.takes_fixed_base());
    let outputs: Vec<Function> = fixed.collect();
    let mut next = 0;
    for (place, (seed, robot, _)) in robots(places.end, 0xacc0).enumerate() {
        let n = robot.joints.len();
        if n > longest {
            continue;
        }
        if !places.contains(&place) {
            next += count;
            continue;
        }
        let bench = Bench::new(Setup::whole(&robot));
        let states = seeded(&robot, STATES, SEED ^ seed);
        for _ in 0..count {
            let function = outputs[next % outputs.len()];
            next += 1;
            let request = Request::new(&[function]);
            let what = format!("seed {seed}, {n} joints, {function}");
            let generated = match generate(&robot, &request) {
                Ok(generated) => generated,
                // D is singular in every state, or the base parameters cannot be written
                // down: other tests check that these arms are refused.
                Err(GenerateError::Singular { .. } | GenerateError::Base(..)) => continue,
                Err(error) => panic!("{what}: {error}"),
            };
            for emitted in &generated.emitted {
                let scalar = emitted.scalar;
                for measurement in bench.measure(&Code::emitted(emitted), &states, &states) {
                    let (quantity, error) = (measurement.quantity, measurement.vector);
                    assert!(error <= VECTOR, "{what}, {scalar}: {measurement:?}");
                    let (most, robots) = worst.entry((quantity, scalar)).or_default();
                    *most = most.max(error);
                    *robots += 1;
                }
            }
        }
    }
    worst
}

daily_and_campaign! {
    short_arms_are_accurate: (0..2, 12), (2..24, 40);
}

fn short_arms_are_accurate(places: Range<usize>, least: usize) {
    let worst = campaign(places, 6, 3);
    assert!(worst.len() > least, "{}", worst.len());
}

#[test]
#[ignore = "a quarter of an hour with --release: by hand"]
fn by_hand_two_hundred_robots_are_accurate() {
    let worst = campaign(0..200, 4, 7);
    for ((quantity, scalar), (error, robots)) in &worst {
        println!("{quantity:?} {scalar}: {error:.1} u, {robots} robots");
    }
    assert!(worst.len() > 50, "{}", worst.len());
}
