//! Second derivatives of λᵀτ and λᵀq̈: against Pinocchio and CasADi, in both scalars, in a scene and under
//! a payload, and what they cost.

use std::path::Path;

use dalembert_codegen::workspace::{Argument, Runtime, Sizes, seeded};
use dalembert_codegen::{Function, Generated, Request, ScalarType, generate};
use dalembert_model::outputs::RuntimeParameter;
use dalembert_model::robot::Robot;
use serde_json::Value;

use crate::support;

const BOTH: [Function; 2] = [
    Function::InverseDynamicsSecondDerivatives,
    Function::ForwardDynamicsSecondDerivatives,
];

/// The bound against the files, normwise.
const FILES: f64 = 1e-12;

fn states(name: &str) -> Vec<Value> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/second_derivatives");
    let text = std::fs::read_to_string(folder.join(format!("{name}.json"))).unwrap();
    let mut file: Value = serde_json::from_str(&text).unwrap();
    let states: Vec<Value> = serde_json::from_value(file["states"].take()).unwrap();
    assert_eq!(states.len(), 5);
    states
}

fn of(robot: &Robot, functions: &[Function], request: Request) -> Generated {
    let request = Request {
        functions: functions.to_vec(),
        ..request
    };
    generate(robot, &request).unwrap_or_else(|error| panic!("{error}"))
}

/// Returns both by one generation in f64.
fn double(robot: &Robot, functions: &[Function]) -> Generated {
    let request = Request {
        scalars: vec![ScalarType::F64],
        ..Request::default()
    };
    of(robot, functions, request)
}

/// The code and the formulas that it is compared with elsewhere, at every value of the files;
/// those of the accelerations may err by the condition of D.
#[test]
fn they_are_what_others_give() {
    let small = ["planar2r", "planar3r", "stanford"];
    let large = ["puma560", "ur10", "panda"];
    // The large ones by their formulas where tests are not optimised.
    let by_code = |name: &str| !cfg!(debug_assertions) || small.contains(&name);
    for name in small.into_iter().chain(large) {
        let robot = support::robot(name);
        let runtime = Runtime::new(&robot);
        let generated = by_code(name).then(|| double(&robot, &BOTH));
        let sizes = Sizes::whole(robot.joints.len());
        for json in states(name) {
            let state = support::given(&json);
            for (index, function) in BOTH.into_iter().enumerate() {
                let granted = runtime.granted(function, &state);
                let mut all = vec![runtime.run(function, &state)];
                all.extend(generated.iter().map(|own| own.emitted[index].run(&state)));
                for mut found in all {
                    for quantity in function.quantities() {
                        let known = support::numbers(&json[quantity.given().unwrap()]);
                        let rest = found.split_off(quantity.len(sizes));
                        let size = known.iter().fold(1e-3, |most: f64, x| most.max(x.abs()));
                        assert_eq!(known.len(), found.len());
                        for (a, b) in found.iter().zip(&known) {
                            let error = (a - b).abs() / size / granted.to(*quantity);
                            assert!(error <= FILES, "{name} {quantity:?}: {error:e}");
                        }
                        found = rest;
                    }
                }
            }
        }
    }
}

/// Against the runtime in both scalars: whole, with payload and gravity as arguments, and with
/// a joint locked.
#[test]
fn rounding_stays_within_the_bound() {
    let robot = support::robot("planar3r");
    let held = "\n[scene.held]\nlock = { 2 = 0.4 }\n";
    let scene = support::reading_with("planar3r", held).scenes.pop();
    let loaded = Request {
        parameters: RuntimeParameter::ALL.to_vec(),
        ..Request::default()
    };
    let held = Request {
        scene,
        ..Request::default()
    };
    for request in [Request::default(), loaded, held] {
        let scene_robot = request.scene_robot(&robot).unwrap();
        let own = of(&robot, &BOTH, request);
        let states = scene_robot.states(60, 11);
        let runtime = Runtime::in_scene(scene_robot);
        support::rounds_well(&own.emitted, &runtime, &states, "");
    }
}

/// They are symmetric where they should be, linear in λ, and what the joints at rest leave:
/// nothing depends on the first joint's position but by gravity, which is along its axis.
#[test]
fn they_keep_what_every_arm_keeps() {
    let robot = support::robot("stanford");
    let generated = double(&robot, &BOTH[..1]);
    let n = robot.joints.len();
    let mut state = seeded(&robot, 1, 3).remove(0);
    let found = generated.emitted[0].run(&state);
    for matrix in [0, 2] {
        let entry = |i: usize, k: usize| found[matrix * n * n + i * n + k];
        for i in 0..n {
            assert!((0..n).all(|k| entry(i, k) == entry(k, i)));
        }
    }
    for k in 0..n {
        assert_eq!(
            [found[k], found[n * n + k], found[3 * n * n + k * n]],
            [0.0; 3]
        );
    }
    for x in state.of_mut(Argument::Multiplier) {
        *x *= 2.0;
    }
    let doubled = generated.emitted[0].run(&state);
    assert!(found.iter().zip(&doubled).all(|(x, y)| 2.0 * x == *y));
}

/// Of CasADi's Hessians of λᵀτ and λᵀq̈ after common subexpressions, at the best of its ways, there
/// are 5309 and 6833 operations of the PUMA, 15464 and 19401 of the Panda
/// (`benches/peers/peers.py counts`): at most half.
#[test]
fn they_cost_half_of_casadi_s() {
    for (name, most) in [("puma560", [2654, 3416]), ("panda", [7732, 9700])] {
        // The larger one where tests are not optimised would take them minutes.
        if cfg!(debug_assertions) && name == "panda" {
            continue;
        }
        let generated = double(&support::robot(name), &BOTH);
        for (function, most) in generated.functions.iter().zip(most) {
            let counts = function.counts().operations();
            assert!(counts <= most, "{name}: {counts}");
        }
    }
}
