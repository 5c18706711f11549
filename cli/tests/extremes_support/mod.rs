//! The extreme cases as robots with exact parameters.

use std::path::PathBuf;

use dalembert_codegen::ScalarType;
use dalembert_codegen::workspace::{JointState, Random};
use dalembert_model::number::{Angle, Rational};
use dalembert_model::robot::{Inertia, Joint, JointKind, Robot};
use serde_json::Value;

/// One robot at one state.
pub struct Extreme {
    pub id: String,
    pub category: String,
    pub robot: Robot,
    pub state: JointState,
}

/// Reads the file; parameters and states are rounded to the scalar.
pub fn read(scalar: ScalarType) -> Vec<Extreme> {
    let file = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../model/tests/data/extremes.json");
    let json: Value = serde_json::from_str(&std::fs::read_to_string(file).unwrap()).unwrap();
    let extreme = |json: &Value| {
        let text = |key: &str| json[key].as_str().unwrap().to_owned();
        let [q, qd, qdd] = ["q", "qd", "qdd"].map(|key| numbers(&json[key], scalar));
        Extreme {
            id: text("id"),
            category: text("category"),
            robot: robot(&json["robot"], scalar),
            state: JointState {
                q,
                qd,
                qdd,
                ..JointState::default()
            },
        }
    };
    let cases = json["cases"].as_array().unwrap();
    cases.iter().map(extreme).collect()
}

/// Returns the robot with its numbers exactly as they are: no angle is snapped.
fn robot(json: &Value, scalar: ScalarType) -> Robot {
    let column = |key: &str| numbers(&json[key], scalar);
    let [alpha, a, d, offset, mass] = ["alpha", "a", "d", "off", "m"].map(column);
    let kinds = json["types"].as_str().unwrap().chars();
    let joint = |(i, kind): (usize, char)| {
        let tensor = numbers(&json["I"][i], scalar);
        let com = numbers(&json["r"][i], scalar);
        Joint {
            kind: match kind {
                'R' => JointKind::Revolute,
                _ => JointKind::Prismatic,
            },
            alpha: match json["sa"][i].as_f64().zip(json["ca"][i].as_f64()) {
                Some(pair) => right_angle(pair),
                None => radians(alpha[i]),
            },
            a: exact(a[i]),
            d: exact(d[i]),
            theta: radians(offset[i]),
            mass: exact(mass[i]),
            com: [0, 1, 2].map(|axis| exact(com[axis])),
            inertia: Inertia::of(std::array::from_fn(|k| exact(tensor[k]))),
            ..Joint::default()
        }
    };
    let gravity = column("g");
    Robot {
        name: "extreme".into(),
        gravity: [0, 1, 2].map(|axis| exact(gravity[axis])),
        joints: kinds.enumerate().map(joint).collect(),
        ..Robot::default()
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

fn exact(value: f64) -> Rational {
    Rational::from_float(value).unwrap()
}

fn numbers(json: &Value, scalar: ScalarType) -> Vec<f64> {
    let numbers = json.as_array().unwrap().iter();
    let numbers = numbers.map(|x| x.as_f64().unwrap());
    match scalar {
        ScalarType::F64 => numbers.collect(),
        ScalarType::F32 => numbers.map(|x| f64::from(x as f32)).collect(),
    }
}

/// Draws 1000 states within the magnitudes of a state: the largest |q|, |q̇| and |q̈| of all joints
/// of the same kind.
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
    let mut drawn = || JointState::new(|argument| within(state.entries(argument)));
    (0..1000).map(|_| drawn()).collect()
}
