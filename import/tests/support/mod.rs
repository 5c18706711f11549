//! The URDFs, their options and golden values.
#![allow(dead_code, reason = "each test file uses its own part")]

use dalembert_import::{Imported, Options, import};
use serde_json::Value;

pub const NAMES: [&str; 6] = ["panda", "ur5", "xarm7", "z1", "so101", "twodofs"];

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

pub fn source(name: &str) -> String {
    let path = format!("{}/tests/data/{name}.urdf", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(path).unwrap()
}

pub fn json(name: &str) -> Value {
    let path = format!(
        "{}/tests/data/{name}.golden.json",
        env!("CARGO_MANIFEST_DIR")
    );
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

/// Checks that a text has all of these in it.
#[track_caller]
pub fn has(text: &str, parts: &[&str]) {
    for part in parts {
        assert!(text.contains(part), "{part} is missing:\n{text}");
    }
}

/// Returns the chain of the golden values, every other joint that moves locked at 0.
pub fn snapped(name: &str) -> Options {
    let json = json(name);
    let text = |key: &str| json[key].as_str().unwrap().to_owned();
    let lock = match name {
        "panda" => &["panda_finger_joint1", "panda_finger_joint2"][..],
        "so101" => &["gripper"],
        "z1" => &["jointGripper"],
        _ => &[],
    };
    Options {
        base: Some(text("base")),
        tip: Some(text("tip")),
        lock: lock
            .iter()
            .map(|joint| ((*joint).to_owned(), "0".to_owned()))
            .collect(),
        file: format!("{name}.urdf"),
        snap: true,
        ..Options::default()
    }
}

pub fn exact(name: &str) -> Options {
    Options {
        exact: true,
        ..snapped(name)
    }
}

pub fn imported(name: &str, options: &Options) -> Imported {
    let source = source(name);
    import(&source, options).unwrap_or_else(|errors| panic!("{}", errors.render(name, &source)))
}

/// Returns the errors of an import, as they are printed.
pub fn refused(source: &str, options: &Options) -> String {
    match import(source, options) {
        Ok(imported) => panic!("it was imported:\n{}", imported.text),
        Err(errors) => errors.render("arm.urdf", source),
    }
}

pub fn golden(name: &str) -> Golden {
    flat_states(&json(name))
}

/// Returns the joints and the states of golden values.
pub fn flat_states(json: &Value) -> Golden {
    let joints = json["joints"].as_array().unwrap();
    let states = json["states"].as_array().unwrap();
    let state = |state: &Value| State {
        q: flat(&state["q"]),
        qd: flat(&state["qd"]),
        qdd: flat(&state["qdd"]),
        tau: flat(&state["tau"]),
        gravity: flat(&state["gravity"]),
        inertia: flat(&state["inertia"]),
        pose: flat(&state["tip_pose"]),
    };
    Golden {
        joints: joints
            .iter()
            .map(|name| name.as_str().unwrap().to_owned())
            .collect(),
        states: states.iter().map(state).collect(),
    }
}

fn flat(json: &Value) -> Vec<f64> {
    match json {
        Value::Array(items) => items.iter().flat_map(flat).collect(),
        number => vec![number.as_f64().unwrap()],
    }
}

/// Returns the largest difference relative to the largest entry.
pub fn relative(found: &[f64], expected: &[f64]) -> f64 {
    assert_eq!(found.len(), expected.len());
    let size = expected.iter().fold(0.0f64, |most, x| most.max(x.abs()));
    let off = found.iter().zip(expected).map(|(a, b)| (a - b).abs());
    let off = off.fold(0.0f64, f64::max);
    if size == 0.0 { off } else { off / size }
}
