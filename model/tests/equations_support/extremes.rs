//! The extreme cases: robots and states as exact binary floats, outputs to 30
//! digits.

use std::path::PathBuf;

use dalembert_model::equations::frames::Frames;
use dalembert_model::equations::friction::Friction;
use dalembert_model::equations::{Arm, Link, SinCosPair};
use dalembert_model::robot::{Convention, Inertia, JointKind};
use dalembert_model::scalar::Scalar;
use serde_json::Value;

use super::golden::{numbers, triple};

pub struct Extreme {
    pub id: String,
    pub category: String,
    /// The arm with angles instead of pairs.
    pub robot: Value,
    pub q: Vec<f64>,
    pub qd: Vec<f64>,
    pub qdd: Vec<f64>,
    pub tau: Vec<String>,
    /// Rows; the lower triangle for n ≥ 30.
    pub d: Vec<Vec<String>>,
    pub h: Vec<String>,
    pub c: Vec<String>,
}

pub fn read() -> Vec<Extreme> {
    let file = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/data/extremes.json");
    let json: Value = serde_json::from_str(&std::fs::read_to_string(file).unwrap()).unwrap();
    json["cases"]
        .as_array()
        .unwrap()
        .iter()
        .map(extreme)
        .collect()
}

fn extreme(json: &Value) -> Extreme {
    Extreme {
        id: json["id"].as_str().unwrap().into(),
        category: json["category"].as_str().unwrap().into(),
        robot: json["robot"].clone(),
        q: numbers(&json["q"]),
        qd: numbers(&json["qd"]),
        qdd: numbers(&json["qdd"]),
        tau: texts(&json["tau"]),
        d: json["D"].as_array().unwrap().iter().map(texts).collect(),
        h: texts(&json["h"]),
        c: texts(&json["c"]),
    }
}

fn texts(json: &Value) -> Vec<String> {
    let text = |x: &Value| x.as_str().unwrap().to_string();
    json.as_array().unwrap().iter().map(text).collect()
}

impl Extreme {
    /// Returns the arm in any scalar, from its float parameters and the pair of a
    /// float angle.
    pub fn arm<S: Scalar>(
        &self,
        number: impl Fn(f64) -> S,
        pair: impl Fn(f64) -> SinCosPair<S>,
    ) -> Arm<S> {
        let robot = &self.robot;
        let column = |key: &str| numbers(&robot[key]);
        let [alpha, a, d, offset, mass] = ["alpha", "a", "d", "off", "m"].map(column);
        let types = robot["types"].as_str().unwrap();
        let link = |(i, kind): (usize, char)| {
            let tensor = numbers(&robot["I"][i]);
            let inertia = |k: usize| number(tensor[k]);
            Link {
                kind: match kind {
                    'R' => JointKind::Revolute,
                    _ => JointKind::Prismatic,
                },
                alpha: match robot["sa"][i].as_f64().zip(robot["ca"][i].as_f64()) {
                    Some((sin, cos)) => SinCosPair {
                        sin: number(sin),
                        cos: number(cos),
                    },
                    None => pair(alpha[i]),
                },
                beta: None,
                theta: pair(offset[i]),
                a: number(a[i]),
                d: number(d[i]),
                mass: number(mass[i]),
                com: triple(&robot["r"][i]).map(&number),
                inertia: Inertia::of([0, 1, 2, 3, 4, 5].map(inertia)),
                friction: Friction::none(),
                armature: number(0.0),
            }
        };
        Arm {
            convention: Convention::Standard,
            gravity: triple(&robot["g"]).map(&number),
            base: None,
            tool: None,
            links: types.chars().enumerate().map(link).collect(),
            following: Vec::new(),
            frames: Frames::default(),
        }
    }
}
