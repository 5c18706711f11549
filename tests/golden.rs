//! The checked-in code as compiled, in both scalars, against the torques, D, h and c of an
//! independent library.

use std::fs;
use std::path::Path;

use serde_json::Value;

/// Relative to the largest entry; in f32 it is what rounding the state to f32 costs.
const DOUBLE: f64 = 1e-12;
const SINGLE: f64 = 1e-5;

type Motion = [Vec<f64>; 3];

/// The results of a module at a state, matrices row by row, by the keys of the known ones.
type Outputs = [(&'static str, Vec<f64>); 10];

type Run = fn(&Motion) -> Outputs;

macro_rules! run {
    ($module:ident, $float:ty) => {
        |motion| {
            use dalembert_generated::$module as arm;
            let array = |x: &Vec<f64>| std::array::from_fn(|i| x[i] as $float);
            let [q, qd, qdd]: [[$float; arm::N]; 3] = motion.each_ref().map(array);
            let vector = |x: [$float; arm::N]| x.map(f64::from).to_vec();
            let matrix = |x: [[$float; arm::N]; arm::N]| x.map(vector).concat();
            let both = arm::manipulator_equation(&q, &qd);
            let all = arm::dynamic_coefficients(&q);
            let symbols = all.h.map(matrix).concat();
            [
                ("tau", vector(arm::inverse_dynamics(&q, &qd, &qdd))),
                ("c", vector(arm::gravity(&q))),
                ("c", vector(both.c)),
                ("c", vector(all.c)),
                ("D", matrix(arm::inertia(&q))),
                ("D", matrix(both.d)),
                ("D", matrix(all.d)),
                ("h", vector(arm::coriolis(&q, &qd))),
                ("h", vector(both.h)),
                ("h", by_symbols(&symbols, &motion[1])),
            ]
        }
    };
}

macro_rules! compiled {
    ($($double:ident $single:ident),*) => {
        [$((stringify!($double), run!($double, f64), run!($single, f32))),*]
    };
}

const ROBOTS: [(&str, Run, Run); 6] = compiled![
    panda panda_f32, planar2r planar2r_f32, planar3r planar3r_f32, puma560 puma560_f32,
    stanford stanford_f32, ur10 ur10_f32
];

fn numbers(json: &Value) -> Vec<f64> {
    match json {
        Value::Array(list) => list.iter().flat_map(numbers).collect(),
        number => vec![number.as_f64().unwrap()],
    }
}

fn states(name: &str) -> Vec<Value> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let file = root.join(format!("crates/model/tests/data/golden/{name}.json"));
    let json: Value = serde_json::from_str(&fs::read_to_string(file).unwrap()).unwrap();
    json["states"].as_array().unwrap().clone()
}

fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, |most, x| most.max(x.abs()))
}

/// Asserts that max|a − b| ≤ bound·max|b|.
fn close(a: &[f64], b: &[f64], bound: f64, what: &str) {
    assert_eq!(a.len(), b.len(), "{what}");
    let error = largest(a.iter().zip(b).map(|(a, b)| a - b));
    let size = largest(b.iter().copied());
    let is_close = error <= bound * size && a.iter().all(|x| x.is_finite());
    assert!(is_close, "{what}: error {error:e} of {size:e}");
}

#[test]
fn six_robots_against_the_files() {
    for (name, double, single) in ROBOTS {
        let states = states(name);
        assert_eq!(states.len(), 60);
        for state in &states {
            let motion = ["q", "qd", "qdd"].map(|key| numbers(&state[key]));
            for (run, bound) in [(double, DOUBLE), (single, SINGLE)] {
                for (key, values) in run(&motion) {
                    let what = format!("{name} {key}");
                    close(&values, &numbers(&state[key]), bound, &what);
                }
            }
        }
    }
}

/// Returns h_i = Σ h_ikm q̇_k q̇_m.
fn by_symbols(symbols: &[f64], qd: &[f64]) -> Vec<f64> {
    let n = qd.len();
    let row = |i: usize| {
        let term = |km: usize| symbols[i * n * n + km] * qd[km / n] * qd[km % n];
        (0..n * n).map(term).sum()
    };
    (0..n).map(row).collect()
}
