//! The checked-in code as compiled, in both scalars, against the torques, D, h and c of an
//! independent library.

use std::fs;
use std::path::Path;

use serde_json::Value;

/// The bounds of a result's error, relative to the largest entry: in f32 it is what rounding the
/// state to f32 costs.
const DOUBLE: f64 = 1e-12;
const SINGLE: f64 = 1e-5;

/// q, q̇, q̈ and what is known there.
struct State {
    motion: [Vec<f64>; 3],
    tau: Vec<f64>,
    d: Vec<f64>,
    h: Vec<f64>,
    c: Vec<f64>,
}

/// Everything that a module computes at a state, matrices row by row.
struct Outputs {
    tau: Vec<f64>,
    c: Vec<f64>,
    d: Vec<f64>,
    h: Vec<f64>,
    /// D, h, c of `manipulator_equation`.
    together: [Vec<f64>; 3],
    /// D, h_ikm, c of `dynamic_coefficients`.
    coefficients: [Vec<f64>; 3],
}

struct Compiled {
    name: &'static str,
    double: fn(&[Vec<f64>; 3]) -> Outputs,
    single: fn(&[Vec<f64>; 3]) -> Outputs,
}

macro_rules! run {
    ($module:ident, $float:ty) => {
        |motion| {
            use dalembert_generated::$module as arm;
            let [q, qd, qdd]: [[$float; arm::N]; 3] = motion
                .each_ref()
                .map(|x| std::array::from_fn(|i| x[i] as $float));
            let vector = |x: [$float; arm::N]| x.map(f64::from).to_vec();
            let matrix = |x: [[$float; arm::N]; arm::N]| x.map(vector).concat();
            let both = arm::manipulator_equation(&q, &qd);
            let all = arm::dynamic_coefficients(&q);
            Outputs {
                tau: vector(arm::inverse_dynamics(&q, &qd, &qdd)),
                c: vector(arm::gravity(&q)),
                d: matrix(arm::inertia(&q)),
                h: vector(arm::coriolis(&q, &qd)),
                together: [matrix(both.d), vector(both.h), vector(both.c)],
                coefficients: [matrix(all.d), all.h.map(matrix).concat(), vector(all.c)],
            }
        }
    };
}

macro_rules! compiled {
    ($($double:ident $single:ident),*) => {
        [$(Compiled {
            name: stringify!($double),
            double: run!($double, f64),
            single: run!($single, f32),
        }),*]
    };
}

const ROBOTS: [Compiled; 6] = compiled![
    panda panda_f32,
    planar2r planar2r_f32,
    planar3r planar3r_f32,
    puma560 puma560_f32,
    stanford stanford_f32,
    ur10 ur10_f32
];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn states(name: &str) -> Vec<State> {
    let file = root().join(format!("model/tests/data/golden/{name}.json"));
    let json: Value = serde_json::from_str(&fs::read_to_string(file).unwrap()).unwrap();
    fn numbers(json: &Value) -> Vec<f64> {
        match json {
            Value::Array(list) => list.iter().flat_map(numbers).collect(),
            number => vec![number.as_f64().unwrap()],
        }
    }
    let states = json["states"].as_array().unwrap().iter();
    let state = |json: &Value| State {
        motion: ["q", "qd", "qdd"].map(|key| numbers(&json[key])),
        tau: numbers(&json["tau"]),
        d: numbers(&json["D"]),
        h: numbers(&json["h"]),
        c: numbers(&json["c"]),
    };
    states.map(state).collect()
}

fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, |most, x| most.max(x.abs()))
}

/// Asserts that max|a − b| ≤ bound·max|b|.
fn close(a: &[f64], b: &[f64], bound: f64, what: &str) {
    assert_eq!(a.len(), b.len(), "{what}");
    let error = largest(a.iter().zip(b).map(|(a, b)| a - b));
    let size = largest(b.iter().copied());
    assert!(
        error <= bound * size && a.iter().all(|x| x.is_finite()),
        "{what}: error {error:e} of {size:e}"
    );
}

#[test]
fn six_robots_against_the_files() {
    for robot in ROBOTS {
        let states = states(robot.name);
        assert_eq!(states.len(), 60);
        for (state, (run, bound)) in states.iter().flat_map(|state| {
            [(robot.double, DOUBLE), (robot.single, SINGLE)].map(|way| (state, way))
        }) {
            let out = run(&state.motion);
            let check = |a: &[f64], b: &[f64], what| {
                close(a, b, bound, &format!("{} {what}", robot.name));
            };
            check(&out.tau, &state.tau, "tau");
            for c in [&out.c, &out.together[2], &out.coefficients[2]] {
                check(c, &state.c, "c");
            }
            for d in [&out.d, &out.together[0], &out.coefficients[0]] {
                check(d, &state.d, "D");
            }
            for h in [
                &out.h,
                &out.together[1],
                &by_symbols(&out, &state.motion[1]),
            ] {
                check(h, &state.h, "h");
            }
        }
    }
}

/// Returns h_i = Σ h_ikm q̇_k q̇_m.
fn by_symbols(out: &Outputs, qd: &[f64]) -> Vec<f64> {
    let n = qd.len();
    let row = |i: usize| {
        let pairs = (0..n * n).map(|km| (km / n, km % n));
        pairs
            .map(|(k, m)| out.coefficients[1][(i * n + k) * n + m] * qd[k] * qd[m])
            .sum()
    };
    (0..n).map(row).collect()
}

#[test]
fn what_is_no_number_spreads_and_nothing_panics() {
    for robot in ROBOTS {
        let motion = states(robot.name).remove(0).motion;
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            for which in 0..3 {
                let mut motion = motion.clone();
                let last = motion[which].len() - 1;
                motion[which][last] = bad;
                for run in [robot.double, robot.single] {
                    let out = run(&motion);
                    // Each torque that depends on the last joint: its own at
                    // least, but the last position may have no part in it.
                    let spread = out.tau.iter().any(|x| !x.is_finite());
                    assert!(spread || which == 0, "{} {which} {bad}", robot.name);
                }
            }
        }
    }
}
