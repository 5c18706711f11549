//! Robots that nobody chose: any number of joints, both kinds, both
//! conventions, full inertias, tilted gravity, odd angles.
//!
//! What is generated for them is proved (or `generate` fails), the emitted text
//! stays within the floating bound.

use crate::support;
use crate::support::draw::{Draw, robots};
use dalembert_codegen::workspace::{JointState, Runtime, SEED, seeded};
use dalembert_codegen::{Function, Request, ScalarType, Start, generate};
use dalembert_model::scene::Scene;

/// Returns a function whose code stays small enough for a test.
fn function(n: usize, draw: &mut Draw) -> Function {
    let few = match n {
        0..=3 => 6,
        4..=5 => 5,
        _ => 4,
    };
    Function::ALL[draw.0.below(few)]
}

#[test]
fn proved_and_accurate() {
    let many = if cfg!(debug_assertions) { 12 } else { 24 };
    for (seed, robot, mut draw) in robots(many, 0x5eed) {
        let n = robot.joints.len();
        let function = function(n, &mut draw);
        let what = format!("seed {seed}, {n} joints, {function}");
        let request = Request::of(&[function]);
        // No proof, no code.
        let generated = match generate(&robot, &request) {
            Ok(generated) => generated,
            Err(error) => panic!("{what}: {error}"),
        };
        let runtime = Runtime::new(&robot);
        let states = seeded(&robot, 50, SEED ^ seed);
        assert_eq!(generated.emitted.len(), 2, "{what}");
        support::rounds_well(&generated.emitted, &runtime, &states, &what);
    }
}

/// Each formulation alone leads to a program that is proved.
#[test]
fn every_start_leads_to_the_same_function() {
    for (seed, robot, mut draw) in robots(16, 0xa9ee) {
        let n = robot.joints.len();
        if n > 3 {
            continue;
        }
        let function = function(n, &mut draw);
        for start in Start::all() {
            let name = start.name();
            let request = Request {
                start,
                ..Request::of(&[function])
            };
            if let Err(error) = generate(&robot, &request) {
                panic!("seed {seed}, {n} joints, {function} from {name}: {error}");
            }
        }
    }
}

/// Without velocities, what is left of the torques is D q̈ + c: the scene's
/// code against the whole robot's two functions, which know no scene.
#[test]
fn a_scene_at_rest_is_inertia_and_gravity() {
    let scene = Scene {
        name: "rest".into(),
        velocity_zero: true,
        ..Scene::default()
    };
    for (seed, robot, _) in robots(10, 4_000).filter(|(_, robot, _)| robot.joints.len() <= 5) {
        let run = |function: Function, scene: Option<Scene>| {
            let request = Request {
                scalars: vec![ScalarType::F64],
                scene,
                ..Request::of(&[function])
            };
            generate(&robot, &request)
                .unwrap_or_else(|error| panic!("seed {seed}: {error}"))
                .emitted
                .remove(0)
                .text
        };
        let rest = run(Function::InverseDynamics, Some(scene.clone()));
        let (inertia, gravity) = (run(Function::Inertia, None), run(Function::Gravity, None));
        let n = robot.joints.len();
        for state in seeded(&robot, 10, seed) {
            // Whatever was read of the velocities would show.
            let unread = vec![f64::NAN; n];
            let at = JointState {
                qd: unread,
                ..state.clone()
            };
            let [tau, d, c] = [&rest, &inertia, &gravity].map(|text| text.run_at(&at));
            let expected: Vec<f64> = (0..n)
                .map(|i| c[i] + (0..n).map(|k| d[i * n + k] * state.qdd[k]).sum::<f64>())
                .collect();
            let largest = expected.iter().fold(1.0, |most: f64, x| most.max(x.abs()));
            for (found, expected) in tau.iter().zip(&expected) {
                let error = (found - expected).abs() / largest;
                assert!(error < 1e-12, "seed {seed}: {found} {expected}");
            }
        }
    }
}
