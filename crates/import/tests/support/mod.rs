//! Models, their options and golden values.
#![allow(dead_code, reason = "each test file uses its own part")]

use std::path::{Path, PathBuf};

use dalembert_import::{Import, Motion, Options, import, open};
use dalembert_model::reference::Reference;
use dalembert_model::robot::Robot;
use nalgebra::DVector;
use num_traits::ToPrimitive;
use serde_json::Value;

pub const URDFS: [&str; 6] = ["panda", "ur5", "xarm7", "z1", "so101", "twodofs"];
pub const MJCFS: [&str; 8] = [
    "mjcf/features",
    "mjcf/degrees",
    "mjcf/geoms",
    "mjcf/panda",
    "mjcf/so101",
    "mjcf/xarm7",
    "mjcf/ur5",
    "mjcf/z1",
];

pub struct Golden {
    pub joints: Vec<String>,
    pub states: Vec<State>,
}

pub struct State {
    pub q: Vec<f64>,
    pub qd: Vec<f64>,
    pub qdd: Vec<f64>,
    pub tau: Vec<f64>,
    pub gravity: Vec<f64>,
    /// Row-major.
    pub inertia: Vec<f64>,
    /// [R | p], row-major.
    pub pose: Vec<f64>,
}

/// Returns the path of a file in `tests/data`.
pub fn path(file: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/data")
        .join(file)
}

pub fn data(file: &str) -> String {
    std::fs::read_to_string(path(file)).unwrap()
}

fn file(name: &str) -> String {
    let ending = if name.starts_with("mjcf/") {
        "xml"
    } else {
        "urdf"
    };
    format!("{name}.{ending}")
}

pub fn source(name: &str) -> String {
    data(&file(name))
}

pub fn json(name: &str) -> Value {
    serde_json::from_str(&data(&format!("{name}.golden.json"))).unwrap()
}

/// Returns the chain to a tip with these joints held.
pub fn to(tip: &str, lock: &[(&str, &str)]) -> Options {
    let lock = lock.iter().map(|&(joint, at)| (joint.into(), at.into()));
    Options {
        tips: vec![tip.into()],
        lock: lock.collect(),
        ..Options::default()
    }
}

/// Returns the chain of the golden values, every other joint that moves locked at 0.
pub fn snapped(name: &str) -> Options {
    let json = json(name);
    Options {
        base: json["base"].as_str().map(str::to_owned),
        file: format!("{name}.urdf"),
        snap: true,
        ..to(json["tip"].as_str().unwrap(), &[("*", "0")])
    }
}

pub fn exact(name: &str) -> Options {
    Options {
        exact: true,
        ..snapped(name)
    }
}

pub fn imported(name: &str, options: &Options) -> Import {
    let opened = open(&path(&file(name)), options);
    opened.unwrap().imported.unwrap()
}

pub fn taken(source: &str, options: &Options) -> Import {
    import(source, options)
        .unwrap_or_else(|errors| panic!("{}", errors.in_file("arm.urdf").render()))
}

pub fn golden(name: &str) -> Golden {
    let json = json(name);
    let joints = json["joints"].as_array().unwrap().iter();
    let states = json["states"].as_array().unwrap().iter();
    Golden {
        joints: joints
            .map(|name| name.as_str().unwrap().to_owned())
            .collect(),
        states: states
            .map(|state| State {
                q: flat(&state["q"]),
                qd: flat(&state["qd"]),
                qdd: flat(&state["qdd"]),
                tau: flat(&state["tau"]),
                gravity: flat(&state["gravity"]),
                inertia: flat(&state["inertia"]),
                pose: flat(&state["tip_pose"]),
            })
            .collect(),
    }
}

pub fn flat(json: &Value) -> Vec<f64> {
    match json {
        Value::Array(items) => items.iter().flat_map(flat).collect(),
        number => vec![number.as_f64().unwrap()],
    }
}

/// Returns the largest difference relative to the largest entry.
pub fn relative(found: &[f64], expected: &[f64]) -> f64 {
    assert_eq!(found.len(), expected.len());
    let size = largest(expected);
    let off = found
        .iter()
        .zip(expected)
        .map(|(a, b)| (a - b).abs())
        .fold(0.0f64, f64::max);
    if size == 0.0 { off } else { off / size }
}

pub fn largest(numbers: &[f64]) -> f64 {
    numbers.iter().fold(0.0f64, |most, x| most.max(x.abs()))
}

fn torques(robot: &Robot, runtime: &Reference<f64>, state: &State) -> Vec<f64> {
    let [q, qd, qdd] = [&state.q, &state.qd, &state.qdd].map(|x| DVector::from_vec(x.clone()));
    let tau = runtime.inverse_dynamics(&q, &qd, &qdd).unwrap();
    let damping = |i: usize| robot.joints[i].viscous.to_f64().unwrap() * qd[i];
    (0..tau.len()).map(|i| tau[i] - damping(i)).collect()
}

/// Returns the largest difference from the golden values, relative to their sizes.
pub fn worst(robot: &Robot, golden: &Golden) -> f64 {
    let names = robot.joints.iter().flat_map(|joint| joint.name.clone());
    assert_eq!(names.collect::<Vec<_>>(), golden.joints);
    let runtime = Reference::<f64>::from_robot(robot);
    let mut worst = 0.0f64;
    for state in &golden.states {
        let q = DVector::from_vec(state.q.clone());
        let gravity = runtime.gravity(&q).unwrap();
        let inertia = runtime.inertia(&q).unwrap().transpose();
        let hand = runtime.hand(&q).unwrap().rows();
        for (found, expected) in [
            (&*torques(robot, &runtime, state), &state.tau),
            (gravity.as_slice(), &state.gravity),
            (inertia.as_slice(), &state.inertia),
            (&hand, &state.pose),
        ] {
            worst = worst.max(relative(found, expected));
        }
    }
    worst
}

/// Returns the motion that has all the golden states in it.
pub fn motion(golden: &Golden) -> Motion {
    let most = |of: fn(&State) -> &Vec<f64>| {
        let most = |i: usize| golden.states.iter().map(move |state| of(state)[i].abs());
        let joints = 0..golden.joints.len();
        joints.map(|i| most(i).fold(0.0, f64::max)).collect()
    };
    Motion {
        position: most(|state| &state.q),
        velocity: most(|state| &state.qd),
        acceleration: most(|state| &state.qdd),
    }
}

/// Checks that snapped torques are within the bound, and returns the largest bound; the golden
/// values are rounded by this part of the largest torque.
pub fn bounded(name: &str, imported: &Import, golden: &Golden, rounding: f64) -> f64 {
    let runtime = Reference::<f64>::from_robot(&imported.robot);
    let change = imported.change.as_ref();
    let bounds = change
        .map(|change| change.torques(&motion(golden)))
        .unwrap_or_else(|| vec![0.0; golden.joints.len()]);
    let sizes = golden.states.iter().map(|state| largest(&state.tau));
    let rounding = rounding * sizes.fold(0.0f64, f64::max);
    for state in &golden.states {
        let torques = torques(&imported.robot, &runtime, state);
        for ((torque, known), bound) in torques.iter().zip(&state.tau).zip(&bounds) {
            let off = (torque - known).abs();
            assert!(off <= bound + rounding, "{name}: {off:e} > {bound:e}");
        }
    }
    largest(&bounds)
}
