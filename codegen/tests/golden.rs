//! Values at states of files, which independent libraries gave: Pinocchio, and CasADi for second
//! derivatives. The formulas that code is compared with elsewhere give them all, and so does the
//! code; what divides may err by the condition of what it divides by.

use std::collections::HashMap;

use dalembert_codegen::workspace::{Quantity, Runtime, Sizes};
use dalembert_codegen::{Function, GeneratedCode};
use serde_json::Value;

use crate::support::{self, Case, all_but_one_in, given, largest, numbers, one_in};

const ROBOTS: [&str; 6] = [
    "planar2r", "planar3r", "stanford", "puma560", "ur10", "panda",
];

const FILES: f64 = 1e-12;

/// Values below this in SI units are what rounding leaves of zero.
const LEAST: f64 = 1e-3;

fn states(file: &str, count: usize) -> Vec<Value> {
    let states = support::json(file)["states"].as_array().unwrap().clone();
    assert_eq!(states.len(), count);
    states
}

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
    let mut quantities = function.quantities().iter();
    let quantity = quantities.find(|quantity| quantity.facts().given == Some(key))?;
    Some((function, *quantity))
}

fn off(results: &[f64], known: &[f64]) -> f64 {
    assert_eq!(results.len(), known.len());
    let differences = results.iter().zip(known).map(|(a, b)| (a - b).abs());
    let worst = differences.fold(0.0, |most: f64, x| if x.is_nan() { x } else { most.max(x) });
    worst / largest(known).max(LEAST)
}

fn compare(
    name: &str,
    states: &[Value],
    options: Option<&str>,
    is_compared: impl Fn(usize) -> bool,
) -> [usize; 2] {
    let plain = Case::new(name, "", "outputs: gravity");
    let runtime = Runtime::new(plain.robot());
    let sizes = Sizes::whole(plain.robot().joints.len());
    let mut codes: HashMap<String, GeneratedCode> = HashMap::new();
    let keys = states[0].as_object().unwrap().keys();
    let asked: Vec<_> = keys.filter_map(|key| Some((key, asked(key)?))).collect();
    let mut compared = [asked.len(), 0];
    let values = asked.into_iter().enumerate();
    for (_, (key, (function, quantity))) in values.filter(|(place, _)| is_compared(*place)) {
        let code = options.map(|options| {
            let text = format!("outputs: {}; scalar: f64; {options}", function.text());
            let generated = || Case::new(name, "", &text).generated();
            &*codes.entry(text.clone()).or_insert_with(generated)
        });
        let before = function.quantities().iter().take_while(|q| **q != quantity);
        let start: usize = before.map(|q| q.len(sizes)).sum();
        let range = start..start + quantity.len(sizes);
        for json in states {
            let state = given(json);
            let known = numbers(&json[key.as_str()]);
            let most = FILES * runtime.granted(function, &state).factor(quantity);
            let results = match code {
                Some(code) => code.emitted[0].run(&state),
                None => runtime.run(function, &state),
            };
            let error = off(&results[range.clone()], &known);
            assert!(error <= most, "{name} {key} {options:?}: {error:e}");
        }
        compared[1] += 1;
    }
    compared
}

fn at_frames(name: &str) -> Vec<Value> {
    states(&format!("tests/data/frames/{name}.json"), 5)
}

/// Folders, the number of states in a file and of values in a state, and the options of code.
const WHOLE: [(&str, usize, usize, &str); 2] = [
    ("tests/data/second_derivatives", 5, 8, ""),
    ("../crates/model/tests/data/golden", 60, 4, "fma: on"),
];

fn of_followers() -> Vec<Value> {
    states("../crates/import/tests/data/wafer.golden.json", 5)
}

#[test]
fn formulas() {
    for name in ROBOTS {
        let compared = compare(&format!("frames/{name}"), &at_frames(name), None, |_| true);
        assert_eq!(compared, [76; 2], "{name}");
        for (folder, count, values, _) in WHOLE {
            let states = states(&format!("{folder}/{name}.json"), count);
            assert_eq!(compare(name, &states, None, |_| true), [values; 2]);
        }
    }
    assert_eq!(compare("wafer", &of_followers(), None, |_| true), [23; 2]);
}

support::daily_and_campaign! {
    code_at_frames: (true, 21), (false, 207);
    code_of_whole_robots: (&ROBOTS[..3]), (&ROBOTS[3..]);
    code_of_followers: (one_in::<8>, 3), (all_but_one_in::<8>, 20);
}

fn code_at_frames(is_daily: bool, count: usize) {
    let mut compared = 0;
    for (number, name) in ROBOTS.into_iter().enumerate() {
        let is_compared = |place: usize| {
            let is_small = number < 3 && one_in::<6>(place / 2);
            place % 2 == number % 2 && is_small == is_daily
        };
        let states = at_frames(name);
        compared += compare(&format!("frames/{name}"), &states, Some(""), is_compared)[1];
    }
    assert_eq!(compared, count);
}

fn code_of_whole_robots(robots: &[&str]) {
    for (folder, count, values, options) in WHOLE {
        for name in robots {
            let states = states(&format!("{folder}/{name}.json"), count);
            let compared = compare(name, &states, Some(options), |_| true);
            assert_eq!(compared, [values; 2], "{name}");
        }
    }
}

/// `values` has all outputs of this arm.
fn code_of_followers(is_compared: fn(usize) -> bool, count: usize) {
    let compared = compare("wafer", &of_followers(), Some(""), is_compared);
    assert_eq!(compared, [23, count]);
}
