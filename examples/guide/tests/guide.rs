//! Checks that every Rust block in the guide and in the pages of the examples is part of an
//! example, and that this crate does what the guide says.

use std::fs;
use std::path::Path;

use guide::simulate::{State, step};
use guide::{Joints, arm, carrying, control, hold, picking, varied};

fn texts(folder: &Path, ending: &str) -> Vec<String> {
    let mut contents = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            contents.extend(texts(&path, ending));
        } else if path.extension().is_some_and(|e| e == ending) {
            contents.push(fs::read_to_string(path).unwrap());
        }
    }
    contents
}

#[test]
fn the_code_of_the_guide_is_that_of_the_examples() {
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let sources = texts(&examples, "rs");
    let mut pages = texts(&examples.join("../docs/src"), "md");
    pages.extend(texts(&examples, "md"));
    let mut blocks = 0;
    for page in &pages {
        for part in page.split("```rust\n").skip(1) {
            let code = part.split("```").next().unwrap();
            let is_known = sources.iter().any(|source| source.contains(code));
            assert!(is_known, "this code is nowhere in the examples:\n{code}");
            blocks += 1;
        }
    }
    assert!(blocks >= 18, "{blocks}");
}

const Q: Joints = [0.3, 0.6, -0.4];

const STILL: Joints = [0.0; arm::N];

#[test]
fn an_arm_that_floats_stays_where_it_is() {
    let mut state = State { q: Q, qd: STILL };
    // Without torques it falls.
    let falling = step(&state, &[0.0; arm::N], 0.1);
    assert!(distance(&falling.q, &Q) > 1e-2, "{falling:?}");
    for _ in 0..1000 {
        state = step(&state, &hold::float(&state.q), 1e-3);
    }
    assert!(distance(&state.q, &Q) < 1e-9, "{state:?}");
}

#[test]
fn a_pose_is_held() {
    let q = [0.1, 0.4, -0.1];
    let mut state = State { q, qd: STILL };
    for _ in 0..5000 {
        state = step(&state, &hold::hold(&state.q, &state.qd, &Q), 1e-3);
    }
    assert!(distance(&state.q, &Q) < 1e-4, "{state:?}");
}

#[test]
fn a_payload_is_found() {
    let measured = hold::measured(&[Q, [0.0, 0.2, 0.9], [1.0, -0.3, 0.5]], 0.7);
    let mass = hold::mass(&measured.unwrap()).unwrap();
    assert!((mass - 0.7).abs() < 1e-12, "{mass}");
    assert_eq!(hold::mass(&[]), None);
    assert_eq!(hold::measured(&[Q], -0.7), None);
}

#[test]
fn a_tool_is_held_on_a_wall() {
    let empty = hold::measured(&[Q], 0.0).unwrap()[0].1;
    assert!(distance(&empty, &arm::gravity(&Q)) < 1e-12);
    let wall = hold::hold_a_tool(&Q);
    assert!(wall[0].abs() > 1.0 && empty[0].abs() < 1e-12, "{wall:?}");
}

#[test]
fn a_heavy_link_needs_more() {
    let (q, qd, qdd) = ([0.3, 0.2, -0.4], [0.5, -0.3, 0.2], [1.0, 2.0, 0.5]);
    let torques = arm::inverse_dynamics(&q, &qd, &qdd);
    let same = varied::inverse_dynamics(&q, &qd, &qdd, &varied::load(&varied::BODIES));
    assert!(distance(&torques, &same) < 1e-12);
    let heavy = hold::with_a_heavy_link(&q, &qd, &qdd).unwrap();
    assert!(heavy[1] > 1.1 * torques[1] && (heavy[2] - torques[2]).abs() < 1e-12);
}

#[test]
fn a_motion_is_followed() {
    let error = control::follow(4);
    assert!(error < 1e-4, "{error:e}");
}

#[test]
fn picking_is_within_its_tolerance() {
    let (q, qd, qdd) = ([0.0, 0.7, -1.1], [0.0, 1.5, -2.0], [0.0, 8.0, 5.0]);
    assert!(picking::in_box(&q, &qd, &qdd));
    let payload = carrying::Payload::new(0.5, [0.0, 0.0, 0.02], [0.0; 6]);
    let load = carrying::load(&payload.unwrap());
    let floor = carrying::Gravity([0.0, 0.0, -9.81]);
    let [_, exact @ ..] = carrying::inverse_dynamics(&q, &qd, &qdd, &floor, &load);
    let torques = picking::inverse_dynamics(&q, &qd, &qdd);
    for (i, limit) in [60.0, 25.0].into_iter().enumerate() {
        let off = (torques[i] - exact[i]).abs();
        assert!(off <= 1e-2 * limit, "{off}");
    }
}

fn distance(a: &Joints, b: &Joints) -> f64 {
    let differences = a.iter().zip(b).map(|(a, b)| (a - b).abs());
    differences.fold(0.0, f64::max)
}
