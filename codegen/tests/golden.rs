//! Values at states of files, which independent libraries gave: Pinocchio, and CasADi for second
//! derivatives. The formulas that code is compared with elsewhere give them all, and so does the
//! code; what divides may err by the condition of what it divides by.

use std::collections::HashMap;

use dalembert_codegen::workspace::{Quantity, Runtime, Sizes};
use dalembert_codegen::{Function, Generated};
use serde_json::Value;

use crate::support::{self, Case, given, largest, numbers};

const ROBOTS: [&str; 6] = [
    "planar2r", "planar3r", "stanford", "puma560", "ur10", "panda",
];

/// The bound against the files, normwise.
const FILES: f64 = 1e-12;

/// Values below this in SI units are what rounding leaves of zero.
const LEAST: f64 = 1e-3;

/// Returns the states of a file, which has so many.
fn states(file: &str, count: usize) -> Vec<Value> {
    let states = support::json(file)["states"].take();
    let states: Vec<Value> = serde_json::from_value(states).unwrap();
    assert_eq!(states.len(), count);
    states
}

/// Returns the function and the quantity of a key of a file.
fn asked(key: &str) -> Option<(Function, Quantity)> {
    let (name, view) = key.split_once('@').unwrap_or((key, ""));
    let mut known = Quantity::ALL.iter();
    let quantity = known.find(|quantity| quantity.facts().given == Some(name))?;
    let function = match view {
        "" => quantity.function(),
        view => {
            let text = format!("{}@{view}", quantity.function());
            Function::parse(&text).unwrap_or_else(|error| panic!("{error}"))
        }
    };
    let mut own = function.quantities().iter();
    let quantity = own.find(|quantity| quantity.facts().given == Some(key))?;
    Some((function, *quantity))
}

/// Returns the largest difference as a part of the largest number of the file.
fn off(found: &[f64], known: &[f64]) -> f64 {
    assert_eq!(found.len(), known.len());
    let differences = found.iter().zip(known).map(|(a, b)| (a - b).abs());
    let worst = differences.fold(0.0, |most: f64, x| if x.is_nan() { x } else { most.max(x) });
    worst / largest(known).max(LEAST)
}

/// Compares every value of states with the runtime, and with code by these options one in `every`,
/// from a place among them; returns how many values there are, and how many code gave.
fn compare(name: &str, states: &[Value], options: &str, every: usize, from: usize) -> [usize; 2] {
    let plain = Case::new(name, "", "outputs: gravity");
    let runtime = Runtime::new(plain.robot());
    let sizes = Sizes::whole(plain.robot().joints.len());
    let mut codes: HashMap<String, Generated> = HashMap::new();
    let keys = states[0].as_object().unwrap().keys();
    let asked: Vec<_> = keys.filter_map(|key| Some((key, asked(key)?))).collect();
    let mut compared = [asked.len(), 0];
    for (index, (key, (function, quantity))) in asked.into_iter().enumerate() {
        let code = (index % every == from % every).then(|| {
            let text = format!("outputs: {}; scalar: f64; {options}", function.text());
            &*codes
                .entry(text.clone())
                .or_insert_with(|| Case::new(name, "", &text).generated())
        });
        let before = function.quantities().iter().take_while(|q| **q != quantity);
        let start: usize = before.map(|q| q.len(sizes)).sum();
        let range = start..start + quantity.len(sizes);
        for json in states {
            let state = given(json);
            let known = numbers(&json[key.as_str()]);
            let most = FILES * runtime.granted(function, &state).factor(quantity);
            let error = off(&runtime.run(function, &state)[range.clone()], &known);
            assert!(error <= most, "{name} {key} by the formulas: {error:e}");
            if let Some(code) = code {
                let error = off(&code.emitted[0].run(&state)[range.clone()], &known);
                assert!(error <= most, "{name} {key}: {error:e}");
            }
        }
        compared[1] += usize::from(code.is_some());
    }
    compared
}

/// Values at frames, half of a robot's by code, a sixth where tests are not optimised; other ones of
/// each robot.
#[test]
fn outputs_at_frames() {
    let every = if cfg!(debug_assertions) { 6 } else { 2 };
    for (number, name) in ROBOTS.into_iter().enumerate() {
        let states = states(&format!("tests/data/frames/{name}.json"), 5);
        let [all, coded] = compare(&format!("frames/{name}"), &states, "", every, number);
        assert!(all == 76 && coded >= 76 / every, "{name}: {coded} of {all}");
    }
}

/// Second derivatives; torques, D, h and c with fused products. The large arms by their formulas
/// alone where tests are not optimised.
#[test]
fn whole_robots() {
    for (folder, count, options, values) in [
        ("tests/data/second_derivatives", 5, "", 8),
        ("../crates/model/tests/data/golden", 60, "fma: on", 4),
    ] {
        for (number, name) in ROBOTS.into_iter().enumerate() {
            let states = states(&format!("{folder}/{name}.json"), count);
            let is_large = cfg!(debug_assertions) && number >= 3;
            let (every, from, coded) = match is_large {
                true => (values + 1, values, 0),
                false => (1, 0, values),
            };
            let compared = compare(name, &states, options, every, from);
            assert_eq!(compared, [values, coded], "{name}");
        }
    }
}

/// An arm of which three joints follow others; every second value by code where tests are not
/// optimised. `values` has all of its outputs.
#[test]
fn followers() {
    let states = states("../crates/import/tests/data/wafer.golden.json", 5);
    let every = if cfg!(debug_assertions) { 2 } else { 1 };
    let [all, coded] = compare("wafer", &states, "", every, 0);
    assert!(all == 23 && coded >= 23 / every, "{coded} of {all}");
}
