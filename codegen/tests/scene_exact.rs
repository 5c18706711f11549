//! A scene's code is the full model's at the scene's values: proved, and run.

use dalembert_codegen::workspace::{Argument, Input, Node, Runtime, seeded};
use dalembert_codegen::{Generated, Request, generate};
use dalembert_model::outputs::Axis;
use dalembert_model::scene::Scene;

use crate::support;
use crate::support::case::Case;

/// Compares the scene's text against the runtime of the whole robot, at states that have the
/// scene's values; nothing here goes through what the generator makes of the scene. What is locked
/// must not be read.
fn check(robot: &str, scene: &str, outputs: &str) -> Generated {
    let asked = format!("outputs: {outputs}; scene: test; scalar: f64");
    let case = Case::new(robot, &format!("\n[scene.test]\n{scene}\n"), &asked);
    let (robot, scene) = (case.robot(), case.request.scene.as_ref().unwrap());
    let generated = case.generated();
    let whole = Runtime::new(&scene.apply(robot));
    let n = robot.joints.len();
    let rows = scene.rows(n);
    for mut state in seeded(robot, 20, 7) {
        for (joint, at) in &scene.lock {
            state.q[*joint] = at.to_f64();
            (state.qd[*joint], state.qdd[*joint]) = (0.0, 0.0);
        }
        if scene.velocity_zero {
            state.qd.fill(0.0);
        }
        if scene.acceleration_zero {
            state.qdd.fill(0.0);
        }
        for emitted in &generated.emitted {
            let full = whole.run(emitted.function, &state);
            let mut noisy = state.clone();
            for (joint, _) in &scene.lock {
                for entries in [&mut noisy.q, &mut noisy.qd, &mut noisy.qdd] {
                    entries[*joint] = f64::NAN;
                }
            }
            let found = emitted.run(&noisy);
            let largest = full.iter().fold(1.0f64, |most, x| most.max(x.abs()));
            let mut start = 0;
            let mut expected = Vec::new();
            for quantity in emitted.function.quantities() {
                let mut wanted = vec![0];
                for axis in quantity.shape().0 {
                    let (length, places) = match *axis {
                        Axis::Joints => (n, rows.clone()),
                        _ => {
                            let length = axis.length(emitted.sizes);
                            (length, (0..length).collect())
                        }
                    };
                    let along = |from: &usize| {
                        let from = from * length;
                        places.iter().map(|place| from + place).collect::<Vec<_>>()
                    };
                    wanted = wanted.iter().flat_map(along).collect();
                }
                expected.extend(wanted.into_iter().map(|index| full[start + index]));
                start += quantity.len(emitted.sizes.over(n));
            }
            assert_eq!(found.len(), expected.len());
            for (found, expected) in found.iter().zip(&expected) {
                let error = (found - expected).abs() / largest;
                assert!(error < 1e-13, "{}: {found} {expected}", emitted.function);
            }
        }
    }
    for function in &generated.functions {
        let graph = function.program.graph();
        let reads = |input: Input| match input {
            Input::Sin(joint) | Input::Cos(joint) | Input::PerSpeed(joint) => Some(joint),
            Input::Entry(argument, joint) => Argument::STATE.contains(&argument).then_some(joint),
        };
        let is_locked = |node: &Node| match node {
            Node::Input(input) => reads(*input).is_some_and(|joint| scene.locked(joint).is_some()),
            _ => false,
        };
        assert!(!graph.nodes.iter().any(is_locked), "{}", function.function);
    }
    generated
}

#[test]
fn locked_scenes_are_the_full_model() {
    let some = "inverse_dynamics, gravity, manipulator_equation";
    for (robot, lock) in [
        ("puma560", "4 = 0, 5 = \"pi/2\", 6 = \"1/3\""),
        ("puma560", "1 = 0.5, 4 = \"pi\", 6 = \"pi/6\""),
        ("puma560", "2 = \"-pi/4\", 3 = \"pi/4\""),
        ("stanford", "3 = 0.5"),
        ("stanford", "1 = 0, 2 = \"pi/2\", 5 = -0.3"),
        ("panda", "1 = 0, 3 = \"pi/2\", 5 = 0, 7 = \"pi/4\""),
    ] {
        check(robot, &format!("lock = {{ {lock} }}"), some);
    }
}

#[test]
fn every_function_over_chosen_joints() {
    let first = "inverse_dynamics, inertia, coriolis, gravity, manipulator_equation, \
                 dynamic_coefficients";
    let payload = "payload = { mass = 2.5, com = [0.05, 0, 0.1] }";
    for scene in [
        format!("joints = [3, 1]\n{payload}"),
        "lock = { 2 = \"pi/3\" }\ngravity = [1, -3, 0.5]\nacceleration = \"zero\"".to_owned(),
        // The torque that a brake holds.
        format!(
            "joints = [2, 1]\nlock = {{ 2 = \"pi/3\", 3 = \"pi/2\" }}\nvelocity = \"zero\"\n{payload}"
        ),
    ] {
        check("planar3r", &scene, first);
    }
}

#[test]
fn the_text_says_what_is_left() {
    let scene = "lock = { 4 = 0, 5 = 0, 6 = 0 }\nvelocity = \"zero\"";
    let text = check("puma560", scene, "inverse_dynamics, inertia").text();
    for part in [
        "pub const N: usize = 6;",
        "pub const JOINTS: [usize; 3] = [0, 1, 2];",
        "pub fn inverse_dynamics(q: &[f64; 6], qdd: &[f64; 6]) -> [f64; 3] {",
        "pub fn inertia(q: &[f64; 6]) -> [[f64; 3]; 3] {",
        "//! - q4 = 0 rad, q̇4 = q̈4 = 0;",
    ] {
        assert!(text.contains(part), "{part}\n{}", &text[..3000]);
    }
}

#[test]
fn a_scene_of_another_robot_is_refused() {
    let scene = Scene {
        name: "test".into(),
        joints: Some(vec![0, 4]),
        ..Scene::default()
    };
    let request = Request {
        scene: Some(scene),
        ..Request::default()
    };
    let error = generate(&support::robot("planar2r"), &request).unwrap_err();
    assert!(error.to_string().contains("there is no joint 5"), "{error}");
}
