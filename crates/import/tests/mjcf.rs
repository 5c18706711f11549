//! Models of MuJoCo: torques, gravity loads, inertia matrices and poses are those of the
//! `mujoco` package, and what cannot be read is refused by name.

use crate::support::{Golden, bounded, flat_states, json, largest, locks, path, worst};
use dalembert_import::{Imported, Options, open};

const NAMES: [&str; 8] = [
    "features", "degrees", "geoms", "panda", "so101", "xarm7", "ur5", "z1",
];

fn golden(name: &str) -> (Golden, Options) {
    let json = json(&format!("mjcf/{name}"));
    let options = Options {
        tip: json["tip"].as_str().map(str::to_owned),
        lock: locks(&[("*", "0")]),
        snap: true,
        ..Options::default()
    };
    (flat_states(&json), options)
}

fn imported(name: &str, options: &Options) -> Imported {
    let opened = open(&path(&format!("mjcf/{name}.xml")), options);
    opened.unwrap().imported.unwrap()
}

#[test]
fn exact_digits_give_what_mujoco_gives() {
    for name in NAMES {
        let (golden, options) = golden(name);
        let exact = Options {
            exact: true,
            ..options
        };
        let worst = worst(&imported(name, &exact).robot, &golden);
        println!("{name}: {worst:.1e}");
        assert!(worst < 1e-10, "{name}: {worst:e}");
    }
}

#[test]
fn snapped_torques_stay_within_the_bound() {
    for name in NAMES {
        let (golden, options) = golden(name);
        let size = golden.states.iter().map(|state| largest(&state.tau));
        let rounding = 1e-11 * size.fold(0.0f64, f64::max);
        bounded(name, &imported(name, &options), &golden, |_| rounding);
    }
}
