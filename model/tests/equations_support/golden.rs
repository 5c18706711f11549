//! The golden robots and their states.

use std::path::PathBuf;

use dalembert_model::equations::frames::Frames;
use dalembert_model::equations::friction::Friction;
use dalembert_model::equations::{Arm, Link, SinCosPair};
use dalembert_model::robot::{Convention, Inertia, JointKind};
use serde_json::Value;

/// One state with its outputs.
pub struct State {
    pub q: Vec<f64>,
    pub qd: Vec<f64>,
    pub qdd: Vec<f64>,
    pub tau: Vec<f64>,
    /// Row-major.
    pub d: Vec<f64>,
    pub h: Vec<f64>,
    pub c: Vec<f64>,
}

pub const ROBOTS: [&str; 6] = [
    "puma560", "stanford", "ur10", "panda", "planar2r", "planar3r",
];

/// Returns a golden robot and its states.
pub fn read(name: &str) -> (Arm<f64>, Vec<State>) {
    let file = PathBuf::from(env!("CARGO_MANIFEST_DIR"))
        .join("tests/data/golden")
        .join(format!("{name}.json"));
    let text = std::fs::read_to_string(file).unwrap();
    let json: Value = serde_json::from_str(&text).unwrap();
    let states = json["states"]
        .as_array()
        .unwrap()
        .iter()
        .map(state)
        .collect();
    (arm(&json["robot"]), states)
}

fn state(json: &Value) -> State {
    State {
        q: numbers(&json["q"]),
        qd: numbers(&json["qd"]),
        qdd: numbers(&json["qdd"]),
        tau: numbers(&json["tau"]),
        d: numbers(&json["D"]),
        h: numbers(&json["h"]),
        c: numbers(&json["c"]),
    }
}

fn arm(json: &Value) -> Arm<f64> {
    let modified = json["mdh"].as_bool().unwrap();
    Arm {
        convention: if modified {
            Convention::Modified
        } else {
            Convention::Standard
        },
        gravity: triple(&json["gravity"]),
        base: None,
        tool: None,
        links: json["links"].as_array().unwrap().iter().map(link).collect(),
        following: Vec::new(),
        frames: Frames::default(),
    }
}

fn link(json: &Value) -> Link<f64> {
    let number = |key: &str| json[key].as_f64().unwrap();
    let kind = match json["sigma"].as_u64().unwrap() {
        0 => JointKind::Revolute,
        _ => JointKind::Prismatic,
    };
    let (theta, d) = match kind {
        JointKind::Revolute => (number("offset"), number("d")),
        JointKind::Prismatic => (number("theta"), number("offset")),
    };
    let rows: Vec<_> = json["I"].as_array().unwrap().iter().map(triple).collect();
    Link {
        kind,
        alpha: snapped(number("alpha")),
        beta: None,
        theta: snapped(theta),
        a: number("a"),
        d,
        mass: number("m"),
        com: triple(&json["r"]),
        inertia: Inertia::symmetric(|i, k| rows[i][k]),
        friction: Friction::none(),
        armature: 0.0,
    }
}

/// Returns the pair of an angle, exact when within 1e-14 of a multiple of π/2.
fn snapped(angle: f64) -> SinCosPair<f64> {
    let (sin, cos) = libm::sincos(angle);
    let snap = |x: f64| {
        if (x - x.round()).abs() < 1e-14 {
            x.round()
        } else {
            x
        }
    };
    SinCosPair {
        sin: snap(sin),
        cos: snap(cos),
    }
}

pub fn numbers(json: &Value) -> Vec<f64> {
    json.as_array()
        .unwrap()
        .iter()
        .map(|x| x.as_f64().unwrap())
        .collect()
}

pub fn triple(json: &Value) -> [f64; 3] {
    numbers(json).try_into().unwrap()
}
