//! Every block of Rust in the guide is a piece of this crate or another example, and the
//! crate does what the guide says.

use std::fs;
use std::path::{Path, PathBuf};

use guide::simulate::{State, step};
use guide::{Joints, arm, carrying, control, hold, payload, picking, tool, with_a_kilogram};

/// Returns the files below a folder with this ending.
fn files(folder: &Path, ending: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        match path.is_dir() {
            true => found.extend(files(&path, ending)),
            false if path.extension().is_some_and(|e| e == ending) => found.push(path),
            false => {}
        }
    }
    found
}

#[test]
fn the_code_of_the_guide_is_this_crate() {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let sources = files(&here.join("src"), "rs").into_iter();
    let mut sources: Vec<String> = sources.map(|f| fs::read_to_string(f).unwrap()).collect();
    for example in [
        "adaptive_control",
        "bare_metal",
        "gravity_compensation",
        "swing_up",
        "with_build_script",
    ] {
        let others = files(&here.join("..").join(example).join("src"), "rs").into_iter();
        sources.extend(others.map(|f| fs::read_to_string(f).unwrap()));
    }
    let script = fs::read_to_string(here.join("../with_build_script/build.rs")).unwrap();
    sources.push(script);
    let mut blocks = 0;
    for chapter in files(&here.join("../../docs/src"), "md") {
        let text = fs::read_to_string(&chapter).unwrap();
        for part in text.split("```rust\n").skip(1) {
            let code = part.split("```").next().unwrap();
            assert!(
                sources.iter().any(|source| source.contains(code)),
                "{chapter:?} has code that is nowhere in the examples:\n{code}"
            );
            blocks += 1;
        }
    }
    assert!(blocks >= 8, "{blocks}");
}

#[test]
fn an_arm_that_floats_stays_where_it_is() {
    let start = State {
        q: [0.3, 0.6, -0.4],
        qd: [0.0; 3],
    };
    let mut state = start;
    for _ in 0..1000 {
        let tau = hold::float(&state.q);
        state = step(&state, &tau, 1e-3);
    }
    assert!(distance(&state.q, &start.q) < 1e-9, "{state:?}");
    // Without them it falls.
    let falling = step(&start, &[0.0; 3], 0.1);
    assert!(distance(&falling.q, &start.q) > 1e-2, "{falling:?}");
}

#[test]
fn a_pose_is_held() {
    let pose = [0.3, 0.6, -0.4];
    let mut state = State {
        q: [0.1, 0.4, -0.1],
        qd: [0.0; 3],
    };
    for _ in 0..5000 {
        let tau = hold::hold(&state.q, &state.qd, &pose);
        state = step(&state, &tau, 1e-3);
    }
    assert!(distance(&state.q, &pose) < 1e-4, "{state:?}");
}

#[test]
fn a_payload_is_found() {
    let poses: [Joints; 3] = [[0.3, 0.6, -0.4], [0.0, 0.2, 0.9], [1.0, -0.3, 0.5]];
    // Half a kilogram by another way than the guide's: what picking knows of it, which
    // is 1% of the limits off at most.
    let measured = poses.map(|mut q| {
        q[0] = 0.0;
        let [lift, reach] = picking::inverse_dynamics(&q, &[0.0; 3], &[0.0; 3]);
        (q, [0.0, lift, reach])
    });
    let found = payload::mass(&measured).unwrap();
    assert!((found - 0.5).abs() < 0.2, "{found}");
    let exact = poses.map(|q| {
        let [empty, loaded] = [arm::gravity(&q), with_a_kilogram::gravity(&q)];
        (
            q,
            std::array::from_fn(|i| empty[i] + 0.7 * (loaded[i] - empty[i])),
        )
    });
    assert!((payload::mass(&exact).unwrap() - 0.7).abs() < 1e-12);
    assert_eq!(payload::mass(&[]), None);
}

/// On the wall the first joint carries something, which it does not on the floor.
#[test]
fn a_tool_is_held_on_a_wall() {
    let q = [0.3, 0.6, -0.4];
    let empty = carrying::load(&carrying::Payload::NONE);
    let floor = carrying::gravity(&q, &carrying::Gravity([0.0, 0.0, -9.81]), &empty);
    for (found, expected) in floor.iter().zip(arm::gravity(&q)) {
        assert!((found - expected).abs() < 1e-12);
    }
    let wall = tool::hold_a_tool(&q);
    assert!(wall[0].abs() > 1.0 && floor[0].abs() < 1e-12, "{wall:?}");
}

#[test]
fn a_motion_is_followed() {
    let error = control::follow(4);
    assert!(error < 1e-4, "{error:e}");
}

/// The scene's torques stay within its certificate at a state inside its box.
#[test]
fn picking_is_within_its_tolerance() {
    let (q, qd, qdd) = ([0.0, 0.7, -1.1], [0.0, 1.5, -2.0], [0.0, 8.0, 5.0]);
    assert!(picking::in_box(&q, &qd, &qdd));
    let found = picking::inverse_dynamics(&q, &qd, &qdd);
    // The arm and the half kilogram in its hand, in the plane of its two links.
    let exact = arm::inverse_dynamics(&q, &qd, &qdd);
    let (angle, l1, l2) = (q[1] + q[2], 0.35, 0.28);
    let (w1, w2) = (qd[1], qd[1] + qd[2]);
    let (a1, a2) = (qdd[1], qdd[1] + qdd[2]);
    let arm1 = [l1 * q[1].cos(), l1 * q[1].sin()];
    let arm2 = [l2 * angle.cos(), l2 * angle.sin()];
    let acceleration = [
        -a1 * arm1[1] - w1 * w1 * arm1[0] - a2 * arm2[1] - w2 * w2 * arm2[0],
        a1 * arm1[0] - w1 * w1 * arm1[1] + a2 * arm2[0] - w2 * w2 * arm2[1] + 9.81,
    ];
    let turning = |r: [f64; 2]| 0.5 * (r[0] * acceleration[1] - r[1] * acceleration[0]);
    let load = [
        turning([arm1[0] + arm2[0], arm1[1] + arm2[1]]),
        turning(arm2),
    ];
    for (i, limit) in [60.0, 25.0].into_iter().enumerate() {
        let off = (found[i] - exact[i + 1] - load[i]).abs();
        assert!(off <= 1e-2 * limit, "{off}");
    }
}

fn distance(a: &Joints, b: &Joints) -> f64 {
    let differences = a.iter().zip(b).map(|(a, b)| (a - b).abs());
    differences.fold(0.0, f64::max)
}
