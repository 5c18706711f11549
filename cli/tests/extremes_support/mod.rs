//! The extreme cases as robots with exact parameters.
#![allow(dead_code, reason = "each test file uses its own part")]

pub mod chain;
pub mod rounding;
pub mod runtime;

use std::path::PathBuf;

use dalembert_codegen::workspace::{JointState, Random};
use dalembert_model::number::{Angle, Rational};
use dalembert_model::robot::{Convention, Inertia, Joint, JointKind, Limits, Robot};
use serde_json::Value;

/// One robot at one state.
pub struct Extreme {
    pub id: String,
    pub category: String,
    pub robot: Robot,
    pub state: JointState,
    /// To 30 digits.
    pub tau: Vec<String>,
}

pub fn read() -> Vec<Extreme> {
    let file = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../model/tests/data/extremes.json");
    let json: Value = serde_json::from_str(&std::fs::read_to_string(file).unwrap()).unwrap();
    json["cases"]
        .as_array()
        .unwrap()
        .iter()
        .map(extreme)
        .collect()
}

fn extreme(json: &Value) -> Extreme {
    let text = |x: &Value| x.as_str().unwrap().to_string();
    Extreme {
        id: text(&json["id"]),
        category: text(&json["category"]),
        robot: robot(&json["robot"]),
        state: JointState {
            q: numbers(&json["q"]),
            qd: numbers(&json["qd"]),
            qdd: numbers(&json["qdd"]),
            ..JointState::default()
        },
        tau: json["tau"].as_array().unwrap().iter().map(text).collect(),
    }
}

/// Returns the doubles taken at their word: no angle is snapped.
fn robot(json: &Value) -> Robot {
    let column = |key: &str| numbers(&json[key]);
    let [alpha, a, d, offset, mass] = ["alpha", "a", "d", "off", "m"].map(column);
    let kinds = json["types"].as_str().unwrap().chars();
    let joint = |(i, kind): (usize, char)| {
        let tensor = numbers(&json["I"][i]);
        let com = numbers(&json["r"][i]);
        Joint {
            name: None,
            kind: if kind == 'R' {
                JointKind::Revolute
            } else {
                JointKind::Prismatic
            },
            alpha: match json["sa"][i].as_f64().zip(json["ca"][i].as_f64()) {
                Some(pair) => right_angle(pair),
                None => radians(alpha[i]),
            },
            beta: Angle::default(),
            a: exact(a[i]),
            d: exact(d[i]),
            theta: radians(offset[i]),
            mass: exact(mass[i]),
            com: [0, 1, 2].map(|axis| exact(com[axis])),
            inertia: Inertia::of(std::array::from_fn(|k| exact(tensor[k]))),
            viscous: exact(0.0),
            coulomb: exact(0.0),
            coulomb_width: exact(0.0),
            armature: exact(0.0),
            frame: None,
            limits: Limits::default(),
        }
    };
    let gravity = numbers(&json["g"]);
    Robot {
        name: "extreme".into(),
        convention: Convention::Standard,
        gravity: [0, 1, 2].map(|axis| exact(gravity[axis])),
        base: None,
        tool: None,
        payload_frame: None,
        joints: kinds.enumerate().map(joint).collect(),
        followers: Vec::new(),
        frames: Vec::new(),
    }
}

fn right_angle(pair: (f64, f64)) -> Angle {
    let turns = [(0.0, 1.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 0.0)];
    let turns = turns.iter().position(|known| *known == pair);
    Angle::right_angles(turns.expect("a right angle") as i64)
}

fn radians(value: f64) -> Angle {
    Angle::Radians(exact(value)).canonical()
}

pub fn exact(value: f64) -> Rational {
    Rational::from_float(value).unwrap()
}

pub fn numbers(json: &Value) -> Vec<f64> {
    let number = |x: &Value| x.as_f64().unwrap();
    json.as_array().unwrap().iter().map(number).collect()
}

/// Draws states within the magnitudes of a state: the largest of |q|, |q̇| and |q̈| at a joint of
/// the same kind.
pub fn drawn_like(robot: &Robot, state: &JointState) -> Vec<JointState> {
    let mut random = Random::new(0x7a11);
    let mut within = |values: &[f64]| -> Vec<f64> {
        let kinds = robot.joints.iter().map(|joint| joint.kind);
        let pairs: Vec<(JointKind, f64)> = kinds.zip(values.iter().copied()).collect();
        let most = |kind| {
            let same = pairs.iter().filter(|(own, _)| *own == kind);
            same.fold(0.0f64, |most, (_, x)| most.max(x.abs()))
        };
        let draw = |(kind, _): &(JointKind, f64)| most(*kind) * (2.0 * random.unit() - 1.0);
        pairs.iter().map(draw).collect()
    };
    let mut drawn = || JointState::new(|argument| within(state.of(argument)));
    (0..1000).map(|_| drawn()).collect()
}
