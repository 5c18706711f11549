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
    match name.starts_with("mjcf/") {
        true => format!("{name}.xml"),
        false => format!("{name}.urdf"),
    }
}

pub fn source(name: &str) -> String {
    data(&file(name))
}

/// Returns the values of another program: `joints`, and `states`, matrices in them row by row.
pub fn golden(name: &str) -> Value {
    serde_json::from_str(&data(&format!("{name}.golden.json"))).unwrap()
}

pub fn words(json: &Value) -> Vec<&str> {
    let words = json.as_array().into_iter().flatten();
    words.map(|word| word.as_str().unwrap()).collect()
}

pub fn states(golden: &Value) -> &[Value] {
    golden["states"].as_array().unwrap()
}

pub fn vector(state: &Value, key: &str) -> DVector<f64> {
    DVector::from_vec(flat(&state[key]))
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
    let json = golden(name);
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
    let offs = found.iter().zip(expected).map(|(a, b)| (a - b).abs());
    let off = offs.fold(0.0f64, f64::max);
    if size == 0.0 { off } else { off / size }
}

pub fn largest(numbers: &[f64]) -> f64 {
    numbers.iter().fold(0.0f64, |most, x| most.max(x.abs()))
}

/// Returns the torques at a state without those of damping.
fn torques(robot: &Robot, runtime: &Reference<f64>, state: &Value) -> Vec<f64> {
    let [q, qd, qdd] = ["q", "qd", "qdd"].map(|key| vector(state, key));
    let tau = runtime.inverse_dynamics(&q, &qd, &qdd).unwrap();
    let damping = |i: usize| robot.joints[i].viscous.to_f64().unwrap() * qd[i];
    (0..tau.len()).map(|i| tau[i] - damping(i)).collect()
}

/// Returns the largest difference from the golden values, relative to their sizes.
pub fn worst(robot: &Robot, golden: &Value) -> f64 {
    let names = robot.joints.iter().flat_map(|joint| joint.name.as_deref());
    assert_eq!(names.collect::<Vec<_>>(), words(&golden["joints"]));
    let runtime = Reference::<f64>::from_robot(robot);
    let mut worst = 0.0f64;
    for state in states(golden) {
        let q = vector(state, "q");
        let gravity = runtime.gravity(&q).unwrap();
        let inertia = runtime.inertia(&q).unwrap().transpose();
        let hand = runtime.hand(&q).unwrap().rows();
        for (found, key) in [
            (&*torques(robot, &runtime, state), "tau"),
            (gravity.as_slice(), "gravity"),
            (inertia.as_slice(), "inertia"),
            (&hand, "tip_pose"),
        ] {
            worst = worst.max(relative(found, &flat(&state[key])));
        }
    }
    worst
}

/// Returns the motion that has all the golden states in it.
pub fn motion(golden: &Value) -> Motion {
    let most = |key: &str| {
        let sizes = states(golden).iter().map(|state| vector(state, key).abs());
        sizes
            .reduce(|one, other| one.sup(&other))
            .unwrap()
            .as_slice()
            .to_vec()
    };
    Motion {
        position: most("q"),
        velocity: most("qd"),
        acceleration: most("qdd"),
    }
}

/// Checks that snapped torques are within the bound, and returns the largest bound; the golden
/// values are rounded by this part of the largest torque.
pub fn bounded(name: &str, imported: &Import, golden: &Value, rounding: f64) -> f64 {
    let runtime = Reference::<f64>::from_robot(&imported.robot);
    let change = imported.change.as_ref();
    let changes = change.map(|change| change.torques(&motion(golden)));
    let bounds = changes.unwrap_or_else(|| vec![0.0; words(&golden["joints"]).len()]);
    let known = states(golden).iter().map(|state| flat(&state["tau"]));
    let rounding = rounding * known.map(|tau| largest(&tau)).fold(0.0f64, f64::max);
    for state in states(golden) {
        let torques = torques(&imported.robot, &runtime, state);
        for ((torque, known), bound) in torques.iter().zip(flat(&state["tau"])).zip(&bounds) {
            let off = (torque - known).abs();
            assert!(off <= bound + rounding, "{name}: {off:e} > {bound:e}");
        }
    }
    largest(&bounds)
}
