//! Golden robots and extreme cases: states with τ, D, h and c as others have them.

use dalembert_model::equations::{Arm, Link, SinCosPair};
use dalembert_model::reference::Reference;
use dalembert_model::robot::{Convention, Inertia, JointKind};
use dalembert_model::scalar::Scalar;
use serde_json::Value;

use super::random::CONVENTIONS;
use super::{arm, link};
use crate::support::{data, vector};

fn json(name: &str) -> Value {
    serde_json::from_str(&data(&format!("{name}.json"))).unwrap()
}

pub fn list(json: &Value) -> &[Value] {
    json.as_array().unwrap()
}

/// Returns the numbers of lists in lists, also where they are texts.
pub fn numbers(json: &Value) -> Vec<f64> {
    match json {
        Value::Array(items) => items.iter().flat_map(numbers).collect(),
        Value::String(digits) => vec![digits.parse().unwrap()],
        number => vec![number.as_f64().unwrap()],
    }
}

fn triple(json: &Value) -> [f64; 3] {
    numbers(json).try_into().unwrap()
}

pub fn read(name: &str) -> (Arm<f64>, Vec<Value>) {
    let json = json(&format!("golden/{name}"));
    let robot = &json["robot"];
    let convention = CONVENTIONS[usize::from(robot["mdh"].as_bool().unwrap())];
    let links = list(&robot["links"]).iter().map(golden_link).collect();
    let golden = arm(convention, triple(&robot["gravity"]), links);
    (golden, list(&json["states"]).to_vec())
}

fn golden_link(json: &Value) -> Link<f64> {
    let number = |key: &str| json[key].as_f64().unwrap();
    let (kind, theta, d) = match json["sigma"].as_u64().unwrap() {
        0 => (JointKind::Revolute, "offset", "d"),
        _ => (JointKind::Prismatic, "theta", "offset"),
    };
    let angles = ["alpha", theta].map(|key| snapped(number(key)));
    let rows: Vec<_> = list(&json["I"]).iter().map(triple).collect();
    let inertia = Inertia::symmetric(|i, k| rows[i][k]);
    let lengths = ["a", d, "m"].map(number);
    link(kind, angles, lengths, triple(&json["r"]), inertia)
}

/// Returns the pair of an angle, exact when within 1e-14 of a multiple of π/2.
fn snapped(angle: f64) -> SinCosPair<f64> {
    let (sin, cos) = libm::sincos(angle);
    SinCosPair { sin, cos }.map(|x| match (x - x.round()).abs() < 1e-14 {
        true => x.round(),
        false => *x,
    })
}

/// Returns the extreme cases: robots and states as exact binary floats, outputs to 30 digits, of
/// D the lower triangle for n ≥ 30.
pub fn extremes() -> Vec<Value> {
    list(&json("extremes")["cases"]).to_vec()
}

pub fn extreme<S: Scalar>(
    case: &Value,
    number: impl Fn(f64) -> S,
    pair: impl Fn(f64) -> SinCosPair<S>,
) -> Arm<S> {
    let robot = &case["robot"];
    let link_at = |(i, kind): (usize, char)| {
        let kind = match kind {
            'R' => JointKind::Revolute,
            _ => JointKind::Prismatic,
        };
        let entry = |key: &str| robot[key][i].as_f64();
        let known = |key: &str| entry(key).unwrap();
        let twist = match (entry("sa"), entry("ca")) {
            (Some(sin), Some(cos)) => SinCosPair { sin, cos }.map(|x| number(*x)),
            _ => pair(known("alpha")),
        };
        let inertia = numbers(&robot["I"][i]);
        let inertia = Inertia::of([0, 1, 2, 3, 4, 5].map(|k| number(inertia[k])));
        let lengths = ["a", "d", "m"].map(|key| number(known(key)));
        let com = triple(&robot["r"][i]).map(&number);
        link(kind, [twist, pair(known("off"))], lengths, com, inertia)
    };
    let kinds = robot["types"].as_str().unwrap().chars();
    let links = kinds.enumerate().map(link_at).collect();
    let gravity = triple(&robot["g"]).map(&number);
    arm(Convention::Standard, gravity, links)
}

/// Returns max|a − b| / max|b|; the larger of the two when b is zero.
pub fn normwise(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
    let error = largest(&mut a.iter().zip(b).map(|(a, b)| (a - b).abs()));
    let size = largest(&mut b.iter().map(|b| b.abs()));
    if size == 0.0 { error } else { error / size }
}

#[track_caller]
pub fn check(results: &[(&str, Vec<f64>)], state: &Value, bound: f64, what: &str) -> f64 {
    let errors = results.iter().map(|(key, values)| {
        let error = normwise(values, &numbers(&state[*key]));
        assert!(error <= bound, "{what}: {key} {error:e}");
        error
    });
    errors.fold(0.0, f64::max)
}

pub fn by_runtime(runtime: &Reference<f64>, state: &Value) -> [(&'static str, Vec<f64>); 4] {
    let [q, qd, qdd] = ["q", "qd", "qdd"].map(|key| vector(&numbers(&state[key])));
    let d = runtime.inertia(&q).unwrap();
    assert_eq!(d, d.transpose());
    let [tau, h, c] = [
        runtime.inverse_dynamics(&q, &qd, &qdd),
        runtime.coriolis(&q, &qd),
        runtime.gravity(&q),
    ]
    .map(|values| values.unwrap().as_slice().to_vec());
    let d = d.as_slice().to_vec();
    [("tau", tau), ("c", c), ("D", d), ("h", h)]
}
