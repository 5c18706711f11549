//! The recursion against the torques of another library.

use dalembert_checker::dynamics::{State, torques};
use dalembert_checker::number::Number;
use dalembert_checker::polynomial::{Polynomial, Work};
use dalembert_checker::scene;
use serde_json::Value;

use crate::support::file;

fn list(value: &Value) -> Vec<f64> {
    value
        .as_array()
        .unwrap()
        .iter()
        .map(|x| x.as_f64().unwrap())
        .collect()
}

/// Returns a robot file of golden parameters.
fn toml(robot: &Value) -> String {
    let convention = if robot["mdh"] == true {
        "modified"
    } else {
        "standard"
    };
    let gravity = list(&robot["gravity"]);
    let mut text =
        format!("name = \"golden\"\nconvention = {convention:?}\ngravity = {gravity:?}\n");
    for link in robot["links"].as_array().unwrap() {
        let number = |key: &str| link[key].as_f64().unwrap();
        let turns = link["sigma"] == 0;
        let kind = if turns { "revolute" } else { "prismatic" };
        text += &format!(
            "[[joint]]\nkind = {kind:?}\nalpha = {:?}\na = {:?}\n",
            number("alpha"),
            number("a")
        );
        text += &format!("offset = {:?}\n", number("offset"));
        text += &match turns {
            true => format!("d = {:?}\n", number("d")),
            false => format!("theta = {:?}\n", number("theta")),
        };
        let rows: Vec<Vec<f64>> = link["I"].as_array().unwrap().iter().map(list).collect();
        let i = [
            rows[0][0], rows[1][1], rows[2][2], rows[0][1], rows[1][2], rows[0][2],
        ];
        text += &format!(
            "mass = {:?}\ncom = {:?}\ninertia = {i:?}\n",
            number("m"),
            list(&link["r"])
        );
    }
    text
}

fn number(value: f64) -> Polynomial {
    Polynomial::constant(value.into())
}

#[test]
fn torques_are_those_of_another_library() {
    for name in [
        "planar2r", "planar3r", "puma560", "stanford", "ur10", "panda",
    ] {
        let golden: Value =
            serde_json::from_str(&file(&format!("model/tests/data/golden/{name}.json"))).unwrap();
        let setting = scene::read(&toml(&golden["robot"]), None).unwrap();
        for state in golden["states"].as_array().unwrap().iter().take(20) {
            let of = |key: &str| list(&state[key]);
            let (q, qd, qdd) = (of("q"), of("qd"), of("qdd"));
            let states = |moves: f64| -> Vec<State<Polynomial>> {
                let joint = |i: usize| State {
                    sin: number(q[i].sin()),
                    cos: number(q[i].cos()),
                    position: number(q[i]),
                    velocity: number(qd[i]),
                    acceleration: number(moves * qdd[i]),
                };
                (0..q.len()).map(joint).collect()
            };
            let run = |moves: f64, loads| {
                torques(&setting, &states(moves), loads, &mut Work::default()).unwrap()
            };
            for (key, found) in [("tau", run(1.0, [true; 2])), ("h", run(0.0, [false; 2]))] {
                let expected = of(key);
                let size = expected.iter().fold(1e-3f64, |a, b| a.max(b.abs()));
                for (found, expected) in found.iter().zip(&expected) {
                    let value = found.terms.first().map_or(0.0, |term| term.1);
                    assert!(
                        (value - expected).abs() < 1e-12 * size,
                        "{name} {key}: {value} {expected}"
                    );
                    assert!(found.rest < 1e-11 * size, "{name} {key}: {}", found.rest);
                }
            }
        }
    }
}
