//! Values at states of files, which independent libraries gave: Pinocchio, and CasADi for second
//! derivatives. The formulas that code is compared with elsewhere give them all, and so does the
//! code; what divides may err by the condition of what it divides by.

use std::collections::HashMap;
use std::path::Path;

use dalembert_codegen::workspace::{Quantity, Runtime, Sizes};
use dalembert_codegen::{Function, Generated};
use serde_json::Value;

use crate::support::case::Case;
use crate::support::{given, numbers};

const ROBOTS: [&str; 6] = [
    "planar2r", "planar3r", "stanford", "puma560", "ur10", "panda",
];

/// The bound against the files, normwise.
const FILES: f64 = 1e-12;

/// Values below this in SI units are what rounding leaves of zero.
const LEAST: f64 = 1e-3;

fn states(file: &str) -> Vec<Value> {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(file);
    let mut json: Value = serde_json::from_str(&std::fs::read_to_string(file).unwrap()).unwrap();
    serde_json::from_value(json["states"].take()).unwrap()
}

/// Returns the function and the quantity of a key of a file.
fn asked(key: &str) -> Option<(Function, Quantity)> {
    let (name, view) = key.split_once('@').unwrap_or((key, ""));
    let mut known = Quantity::ALL.iter();
    let quantity = known.find(|quantity| quantity.given() == Some(name))?;
    let function = match view {
        "" => quantity.function(),
        view => {
            let text = format!("{}@{view}", quantity.function());
            Function::parse(&text).unwrap_or_else(|error| panic!("{error}"))
        }
    };
    let mut own = function.quantities().iter();
    let quantity = own.find(|quantity| quantity.given() == Some(key))?;
    Some((function, *quantity))
}

/// Returns the largest difference as a part of the largest number of the file.
fn off(found: &[f64], known: &[f64]) -> f64 {
    assert_eq!(found.len(), known.len());
    let size = known.iter().fold(LEAST, |most, x| most.max(x.abs()));
    let differences = found.iter().zip(known).map(|(a, b)| (a - b).abs());
    let worst = differences.fold(0.0, |most: f64, x| if x.is_nan() { x } else { most.max(x) });
    worst / size
}

/// Compares every value of a file with the runtime, and with code by these options where it is
/// chosen by its place in the file, which has so many; returns how many code gave of each state.
fn compare(
    name: &str,
    states: &[Value],
    options: &str,
    values: usize,
    is_coded: impl Fn(usize) -> bool,
) -> usize {
    let plain = Case::new(name, "", "outputs: gravity");
    let runtime = Runtime::new(plain.robot());
    let sizes = Sizes::whole(plain.robot().joints.len());
    let mut codes: HashMap<String, Generated> = HashMap::new();
    let keys = states[0].as_object().unwrap().keys();
    let asked: Vec<_> = keys.filter_map(|key| Some((key, asked(key)?))).collect();
    assert_eq!(asked.len(), values, "{name}");
    let mut compared = 0;
    for (index, (key, (function, quantity))) in asked.into_iter().enumerate() {
        let code = is_coded(index).then(|| {
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
            let most = FILES * runtime.granted(function, &state).to(quantity);
            let error = off(&runtime.run(function, &state)[range.clone()], &known);
            assert!(error <= most, "{name} {key} by the formulas: {error:e}");
            if let Some(code) = code {
                let error = off(&code.emitted[0].run(&state)[range.clone()], &known);
                assert!(error <= most, "{name} {key}: {error:e}");
            }
        }
        compared += usize::from(code.is_some());
    }
    compared
}

/// Each sixth value of a robot's by code where tests are not optimised, other ones of each robot.
#[test]
fn outputs_at_frames() {
    let every = if cfg!(debug_assertions) { 6 } else { 1 };
    for (number, name) in ROBOTS.into_iter().enumerate() {
        let states = states(&format!("tests/data/frames/{name}.json"));
        let frames = format!("frames/{name}");
        let is_coded = |index| index % every == number % every;
        let compared = compare(&frames, &states, "", 76, is_coded);
        assert_eq!(states.len(), 5);
        assert!(compared >= 76 / every, "{name}: {compared}");
    }
}

/// The large arms by their formulas alone where tests are not optimised.
#[test]
fn second_derivatives() {
    for (number, name) in ROBOTS.into_iter().enumerate() {
        let states = states(&format!("tests/data/second_derivatives/{name}.json"));
        let is_coded = !cfg!(debug_assertions) || number < 3;
        let compared = compare(name, &states, "", 8, |_| is_coded);
        assert_eq!(states.len(), 5);
        assert_eq!(compared, if is_coded { 8 } else { 0 }, "{name}");
    }
}

/// Torques, D, h and c with fused products.
#[test]
fn fused_products() {
    for (number, name) in ROBOTS.into_iter().enumerate() {
        let states = states(&format!("../model/tests/data/golden/{name}.json"));
        let is_coded = !cfg!(debug_assertions) || number < 3;
        let compared = compare(name, &states, "fma: on", 4, |_| is_coded);
        assert_eq!(states.len(), 60);
        assert_eq!(compared, if is_coded { 4 } else { 0 }, "{name}");
    }
}
