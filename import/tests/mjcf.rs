//! Models of MuJoCo: torques, gravity loads, inertia matrices and poses are those of the
//! `mujoco` package, and what cannot be read is refused by name.

use std::path::{Path, PathBuf};

use crate::support::{Golden, flat_states, relative};
use dalembert_import::{Imported, Motion, Options, Text, import_text};
use dalembert_model::reference::Reference;
use nalgebra::DVector;
use num_traits::ToPrimitive;
use serde_json::Value;

/// With every way to write a model, and real arms as MuJoCo saves them.
const NAMES: [&str; 8] = [
    "features", "degrees", "geoms", "panda", "so101", "xarm7", "ur5", "z1",
];

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/mjcf")
}

fn text(name: &str) -> Text {
    let path = folder().join(format!("{name}.xml"));
    let read = |path: &Path| std::fs::read_to_string(path).map_err(|error| error.to_string());
    let text = Text::of(&format!("{name}.xml"), read(&path).unwrap());
    text.with_includes(&path, read).unwrap()
}

fn golden(name: &str) -> (Golden, Options) {
    let path = folder().join(format!("{name}.golden.json"));
    let json: Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    let options = Options {
        tip: json["tip"].as_str().map(str::to_owned),
        lock: vec![("*".to_owned(), "0".to_owned())],
        snap: true,
        ..Options::default()
    };
    (flat_states(&json), options)
}

fn imported(name: &str, options: &Options) -> Imported {
    let text = text(name);
    import_text(&text, options).unwrap_or_else(|errors| panic!("{}", text.render(&errors.0)))
}

/// Returns the largest differences of torques, and of all else relative to its size.
fn compared(name: &str, exact: bool) -> (Vec<f64>, f64, Imported) {
    let (golden, options) = golden(name);
    let imported = imported(name, &Options { exact, ..options });
    let robot = &imported.robot;
    let names: Vec<_> = robot
        .joints
        .iter()
        .flat_map(|joint| joint.name.clone())
        .collect();
    assert_eq!(names, golden.joints, "{name}");
    let runtime = Reference::<f64>::from_robot(robot);
    let (mut torques, mut worst) = (vec![0.0f64; names.len()], 0.0f64);
    for state in &golden.states {
        let [q, qd, qdd] = [&state.q, &state.qd, &state.qdd].map(|x| DVector::from_vec(x.clone()));
        let mut tau = runtime.inverse_dynamics(&q, &qd, &qdd).unwrap();
        for (i, joint) in robot.joints.iter().enumerate() {
            tau[i] -= joint.viscous.to_f64().unwrap() * qd[i];
            torques[i] = torques[i].max((tau[i] - state.tau[i]).abs());
        }
        let gravity = runtime.gravity(&q).unwrap();
        let inertia = runtime.inertia(&q).unwrap().transpose();
        let hand = runtime.hand(&q).unwrap().rows();
        for (found, expected) in [
            (tau.as_slice(), &state.tau),
            (gravity.as_slice(), &state.gravity),
            (inertia.as_slice(), &state.inertia),
            (&hand, &state.pose),
        ] {
            worst = worst.max(relative(found, expected));
        }
    }
    (torques, worst, imported)
}

/// Digits as they stand.
#[test]
fn exact_digits_give_what_mujoco_gives() {
    for name in NAMES {
        let (_, worst, _) = compared(name, true);
        println!("{name}: {worst:.1e}");
        assert!(worst < 1e-10, "{name}: {worst:e}");
    }
}

/// What quaternions were meant to be changes no more than is said.
#[test]
fn snapped_torques_stay_within_the_bound() {
    for name in NAMES {
        let (golden, _) = golden(name);
        let (torques, _, imported) = compared(name, false);
        let most = |part: fn(&crate::support::State) -> &Vec<f64>| {
            let most = |i: usize| golden.states.iter().map(move |state| part(state)[i].abs());
            (0..torques.len())
                .map(|i| most(i).fold(0.0, f64::max))
                .collect()
        };
        let motion = Motion {
            position: most(|state| &state.q),
            velocity: most(|state| &state.qd),
            acceleration: most(|state| &state.qdd),
        };
        let bounds = imported.change.map(|change| change.torques(&motion));
        let bounds = bounds.unwrap_or_else(|| vec![0.0; torques.len()]);
        let size = golden.states.iter().flat_map(|state| &state.tau);
        let rounding = 1e-11 * size.fold(0.0f64, |most, x| most.max(x.abs()));
        for (off, bound) in torques.iter().zip(&bounds) {
            assert!(*off <= bound + rounding, "{name}: {off:e} > {bound:e}");
        }
        println!(
            "{name}: {} snaps, {torques:?} of {bounds:?}",
            imported.snaps.len()
        );
    }
}
