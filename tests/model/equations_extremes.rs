//! Every formulation in f64 against τ, D, h and c of an independent library.
//!
//! The extreme cases: speeds, sizes, mass ratios, far bases, huge angles, long snakes; the
//! generic runtime within ulps, the wide float against the 30 digits.

use crate::equations_support::golden::{self, by_runtime, check, extreme, list, numbers, read};
use crate::equations_support::{placed, sincos};
use crate::support::{ROBOTS, generated, reading, vector};
use dalembert_model::equations::{Arm, Formulation, SinCosPair};
use dalembert_model::number::parse::parse_decimal;
use dalembert_model::number::{Rational, Wide};
use dalembert_model::reference::Reference;
use dalembert_model::scalar::Scalar;
use nalgebra::DVector;
use serde_json::Value;

const U: f64 = f64::EPSILON / 2.0;
const STATE: [&str; 3] = ["q", "qd", "qdd"];

fn runtime(case: &Value) -> Reference<f64> {
    Reference::new(extreme(case, |x| x, sincos))
}

#[test]
fn the_runtime_stays_within_100_u() {
    let mut worst = (0.0, Value::Null);
    for case in golden::extremes() {
        let (runtime, id) = (runtime(&case), case["id"].to_string());
        let results = by_runtime(&runtime, &case);
        let mut values = results[..2].iter().flat_map(|result| &result.1);
        assert!(values.all(|x| x.is_finite()), "{id}");
        // Products of subnormal speeds underflow: the error is absolute there.
        if case["category"] == "subnormal_vel_nograv" {
            let pairs = results[0].1.iter().zip(numbers(&case["tau"]));
            assert!(pairs.into_iter().all(|(a, b)| (a - b).abs() < 1e-300));
            continue;
        }
        let is_normal = case["category"] == "normal";
        let prefix = &results[..if is_normal { 4 } else { 2 }];
        let error = check(prefix, &case, 100.0 * U, &id);
        if error > worst.0 {
            worst = (error, case["id"].clone());
        }
        if is_normal {
            let [q, qd] = ["q", "qd"].map(|key| vector(&numbers(&case[key])));
            let symbols = runtime.christoffel(&q).unwrap();
            let summed = symbols.iter().map(|h| (qd.transpose() * h * &qd)[0]);
            check(&[("h", summed.collect())], &case, 1000.0 * U, &id);
        }
    }
    println!("worst: {worst:?}");
}

#[test]
fn wrong_lengths_are_errors() {
    let runtime = runtime(&golden::extremes()[0]);
    for (short, argument) in STATE.into_iter().enumerate() {
        let [q, qd, qdd] =
            [0, 1, 2].map(|place| DVector::zeros(if place == short { 5 } else { 6 }));
        let error = runtime.inverse_dynamics(&q, &qd, &qdd).unwrap_err();
        let text = format!("`{argument}` has 5 values, the arm has 6 joints");
        assert_eq!(error.to_string(), text);
    }
    assert!(runtime.gravity(&DVector::zeros(5)).is_err());
}

fn number(x: f64) -> Wide {
    Wide::from_f64(x).unwrap()
}

fn pair(angle: f64) -> SinCosPair<Wide> {
    Wide::sincos_of(angle).unwrap()
}

fn wide(values: &Value) -> Vec<Wide> {
    numbers(values).into_iter().map(number).collect()
}

fn relative(numbers: &[Wide], truth: &[Wide]) -> f64 {
    assert_eq!(numbers.len(), truth.len());
    let largest = |values: &mut dyn Iterator<Item = Wide>| {
        let sizes = values.map(|x| if x.is_negative() { x.neg() } else { x });
        let larger = |a: Wide, b: Wide| if a.sub(&b).is_negative() { b } else { a };
        sizes.fold(Wide::zero(), larger)
    };
    let error = largest(&mut numbers.iter().zip(truth).map(|(a, b)| a.sub(b)));
    let size = largest(&mut truth.iter().copied());
    // The file writes entries below 1e-70 of the scale as zero.
    error.over(&size).unwrap_or(error).magnitude()
}

fn digits(json: &Value) -> Vec<Wide> {
    if let Value::Array(items) = json {
        return items.iter().flat_map(digits).collect();
    }
    let text = json.as_str().unwrap();
    let (digits, power) = text.split_once('e').unwrap_or((text, "0"));
    let ten = Rational::from_integer(10.into()).pow(power.parse().unwrap());
    vec![Wide::from_rational(&(parse_decimal(digits).unwrap() * ten))]
}

fn check_digits(case: &Value, arm: &Arm<Wide>, formulation: Formulation) {
    let at = placed(arm, &numbers(&case["q"]), number, pair);
    let [qd, qdd] = ["qd", "qdd"].map(|key| wide(&case[key]));
    let d = formulation.inertia(arm, &at);
    let rows = d.iter().zip(list(&case["D"]));
    let lower = rows.flat_map(|(row, truth)| row[..list(truth).len()].to_vec());
    for (key, values) in [
        ("tau", formulation.inverse_dynamics(arm, &at, &qd, &qdd)),
        ("D", lower.collect()),
        ("h", formulation.velocity_terms(arm, &at, &qd)),
        ("c", formulation.gravity(arm, &at)),
    ] {
        let (error, id) = (relative(&values, &digits(&case[key])), &case["id"]);
        assert!(error <= 1e-28, "{id} {formulation:?} {key}: {error:e}");
    }
}

#[test]
fn wide_floats_have_28_digits() {
    let cases = golden::extremes();
    assert_eq!(cases.len(), 114);
    for case in cases {
        let arm = extreme(&case, number, pair);
        let is_short = arm.links.len() <= 7;
        for formulation in Formulation::ALL {
            if is_short || formulation == Formulation::NewtonEulerLink {
                check_digits(&case, &arm, formulation);
            }
        }
        check_digits(&case, &arm.fold_base(), Formulation::NewtonEulerLink);
    }
}

#[test]
fn the_runtime_in_f32_stays_within_100_u() {
    let u = f64::from(f32::EPSILON) / 2.0;
    // Out of the range of f32, on purpose.
    let out_of_range = "f32overflow_qd1e20 subnormal_vel_nograv tiny_all tiny_vel_nograv";
    let near_pair = |angle: f64| {
        let (sin, cos) = libm::sincosf(angle as f32);
        SinCosPair { sin, cos }
    };
    let exact = |x: &f32| number(f64::from(*x));
    for case in golden::extremes() {
        let mut categories = out_of_range.split(' ');
        if categories.any(|category| case["category"] == category) {
            continue;
        }
        let runtime = Reference::new(extreme(&case, |x| x as f32, near_pair));
        let truth = extreme(&case, |x| exact(&(x as f32)), |x| near_pair(x).map(exact));
        let [q, qd, qdd] =
            STATE.map(|key| DVector::from_vec(numbers(&case[key])).map(|x| x as f32));
        let tau = runtime.inverse_dynamics(&q, &qd, &qdd).unwrap();
        let big = |values: &DVector<f32>| values.iter().map(exact).collect::<Vec<_>>();
        let rounded: Vec<f64> = q.iter().map(|x| f64::from(*x)).collect();
        let at = placed(&truth, &rounded, number, pair);
        let recursion = Formulation::NewtonEulerLink;
        let truth = recursion.inverse_dynamics(&truth, &at, &big(&qd), &big(&qdd));
        let error = relative(&big(&tau), &truth) / u;
        assert!(error <= 100.0, "{}: {error} u", case["id"]);
    }
}

#[test]
fn formulations_and_runtimes_give_the_golden_states() {
    for name in ROBOTS {
        let (arm, states) = read(name);
        let robot = reading(&generated(name)).robot;
        let runtimes = [Reference::new(arm.clone()), Reference::from_robot(&robot)];
        for state in &states {
            for runtime in &runtimes {
                check(&by_runtime(runtime, state), state, 100.0 * U, name);
            }
            let [q, qd, qdd] = ["q", "qd", "qdd"].map(|key| numbers(&state[key]));
            let at = placed(&arm, &q, |x| x, sincos);
            for formulation in Formulation::ALL {
                let results = [
                    ("tau", formulation.inverse_dynamics(&arm, &at, &qd, &qdd)),
                    ("D", formulation.inertia(&arm, &at).concat()),
                    ("h", formulation.velocity_terms(&arm, &at, &qd)),
                    ("c", formulation.gravity(&arm, &at)),
                ];
                check(&results, state, 1e-12, &format!("{name} {formulation:?}"));
            }
        }
    }
}
