//! Outputs at frames of the robot, in the space of the hand and under a wrench: against
//! Pinocchio, in both scalars, in other languages, scenes and plans; what sharing saves, and
//! what singular poses give.

use std::collections::BTreeMap;
use std::path::Path;

use dalembert_codegen::workspace::{Argument, Emitted, Quantity, Runtime, keep, seeded};
use dalembert_codegen::{
    Function, GenerateError, Generated, Language, Plan, Request, ScalarType, generate,
};
use dalembert_model::outputs::RuntimeParameter;
use dalembert_model::robot::Robot;
use serde_json::Value;

use crate::support::{self, given, numbers};

const ROBOTS: [&str; 6] = [
    "planar2r", "planar3r", "puma560", "stanford", "ur10", "panda",
];

/// The bound against the files, normwise.
const FILES: f64 = 1e-12;

fn of(text: &str) -> Function {
    Function::parse(text).unwrap_or_else(|error| panic!("{error}"))
}

fn file(name: &str) -> Value {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/frames");
    let text = std::fs::read_to_string(folder.join(format!("{name}.json"))).unwrap();
    serde_json::from_str(&text).unwrap()
}

/// Returns the tables of a file's frames.
fn tables(frames: &Value) -> String {
    let keys = ["name", "link", "xyz", "rpy"];
    let table = |frame: &Value| {
        let lines = keys.map(|key| format!("{key} = {}\n", frame[key]));
        format!("\n[[frame]]\n{}", lines.concat())
    };
    frames.as_array().unwrap().iter().map(table).collect()
}

/// Returns a checked-in robot with the frames of its file. Scenes end a robot file.
fn with_frames(name: &str) -> Robot {
    support::read_robot(&with_frames_and(name, ""))
}

/// Returns the file of such a robot, with more at its end.
fn with_frames_and(name: &str, more: &str) -> String {
    let source = support::source(name, "");
    let rows = source.split("\n[scene").next().unwrap();
    rows.to_owned() + &tables(&file(name)["frames"]) + more
}

/// Returns the function and the quantity of a key of a file.
fn asked(key: &str) -> Option<(Function, Quantity)> {
    let (name, view) = key.split_once('@').unwrap_or((key, ""));
    let mut known = Quantity::ALL.iter();
    let quantity = known.find(|quantity| quantity.given() == Some(name))?;
    let function = match view {
        "" => quantity.function(),
        view => of(&format!("{}@{view}", quantity.function())),
    };
    let mut own = function.quantities().iter();
    let quantity = own.find(|quantity| quantity.given() == Some(key))?;
    Some((function, *quantity))
}

/// Values below this in SI units are what rounding leaves of zero.
const LEAST: f64 = 1e-3;

/// Returns the largest difference as a part of the largest number of the file.
fn off(found: &[f64], known: &[f64]) -> f64 {
    assert_eq!(found.len(), known.len());
    let size = known.iter().fold(LEAST, |most, x| most.max(x.abs()));
    let differences = found.iter().zip(known).map(|(a, b)| (a - b).abs());
    let worst = differences.fold(0.0, |most: f64, x| if x.is_nan() { x } else { most.max(x) });
    worst / size
}

/// Returns one quantity of a function's results.
fn part(function: Function, quantity: Quantity, emitted: &Emitted, all: &[f64]) -> Vec<f64> {
    let before = function.quantities().iter().take_while(|q| **q != quantity);
    let start: usize = before.map(|q| q.len(emitted.sizes)).sum();
    all[start..start + quantity.len(emitted.sizes)].to_vec()
}

/// Every value of the files, by the code; what divides may err by the condition of what it
/// divides by.
#[test]
fn the_code_gives_what_pinocchio_gives() {
    let mut compared = 0;
    for (index, name) in ROBOTS.into_iter().enumerate() {
        let (json, robot) = (file(name), with_frames(name));
        let runtime = Runtime::new(&robot);
        let states = json["states"].as_array().unwrap();
        let keys = states[0].as_object().unwrap().keys();
        let asked: Vec<(&String, Function, Quantity)> = keys
            .filter_map(|key| asked(key).map(|(function, quantity)| (key, function, quantity)))
            .collect();
        assert_eq!(asked.len(), 76);
        // Each sixth of a robot's where tests are not optimised, other ones of each robot.
        let every = if cfg!(debug_assertions) { 6 } else { 1 };
        let mine = asked.iter().skip(index % every).step_by(every);
        for (key, function, quantity) in mine {
            let request = Request {
                scalars: vec![ScalarType::F64],
                ..Request::of(&[*function])
            };
            let generated = generate(&robot, &request).unwrap_or_else(|error| panic!("{error}"));
            let emitted = &generated.emitted[0];
            for json in states {
                let state = given(json);
                let found = part(*function, *quantity, emitted, &emitted.run(&state));
                let error = off(&found, &numbers(&json[key.as_str()]));
                let error = error / runtime.granted(*function, &state).to(*quantity);
                assert!(error <= FILES, "{name} {key}: {error:e}");
                compared += 1;
            }
        }
    }
    assert!(compared >= 6 * 5 * 12);
}

/// The formulas that the code is compared with elsewhere, at every value of the files.
#[test]
fn the_runtime_gives_what_pinocchio_gives() {
    for name in ROBOTS {
        let (json, robot) = (file(name), with_frames(name));
        let runtime = Runtime::new(&robot);
        for json in json["states"].as_array().unwrap() {
            let state = given(json);
            for (key, known) in json.as_object().unwrap() {
                let Some((function, quantity)) = asked(key) else {
                    continue;
                };
                let all = runtime.run(function, &state);
                let mut start = 0;
                for own in function.quantities() {
                    let length = own.len(dalembert_codegen::workspace::Sizes::whole(
                        robot.joints.len(),
                    ));
                    if *own == quantity {
                        let error = off(&all[start..start + length], &numbers(known));
                        let error = error / runtime.granted(function, &state).to(quantity);
                        assert!(error <= FILES, "{name} {key}: {error:e}");
                    }
                    start += length;
                }
            }
        }
    }
}

fn operations(robot: &Robot, text: &str) -> usize {
    let request = Request {
        scalars: vec![ScalarType::F64],
        ..Request::of(&[of(text)])
    };
    let generated = generate(robot, &request).unwrap_or_else(|error| panic!("{error}"));
    generated.functions[0].counts().operations()
}

/// Frames of one arm have the way there in common.
#[test]
fn a_bundle_of_frames_costs_less_than_each_alone() {
    for name in ["puma560", "panda"] {
        let robot = with_frames(name);
        for output in ["jacobian", "forward_kinematics"] {
            let parts = ["camera", "elbow", "hand"].map(|frame| format!("{output}@{frame}"));
            let whole = operations(&robot, &format!("see={}", parts.join("+")));
            let alone: usize = parts.iter().map(|part| operations(&robot, part)).sum();
            assert!(whole < alone, "{name} {output}: {whole} of {alone}");
        }
    }
}

/// A Jacobian of some rows, or of a frame before the hand, costs less than all of it.
#[test]
fn what_is_not_asked_for_is_not_computed() {
    let robot = with_frames("puma560");
    let [whole, angular, inner] = [
        "jacobian@camera",
        "jacobian@camera:angular",
        "jacobian@elbow",
    ]
    .map(|text| operations(&robot, text));
    assert!(
        angular < whole && 2 * inner < whole,
        "{whole} {angular} {inner}"
    );
}

const OUTPUTS: [&str; 9] = [
    "jacobian@camera:local",
    "jacobian_rate@elbow:world",
    "operational_inertia@camera:x_y_rz",
    "operational_bias@elbow:linear",
    "inverse_dynamics_with_wrench@camera:local",
    "forward_dynamics_with_wrench@elbow",
    "contact_wrench@camera:linear",
    "momentum_observer",
    "task=operational_inertia@camera:linear+consistent_inverse@camera:linear+null_space_projector@camera:linear",
];

fn generated(robot: &Robot, request: Request) -> Generated {
    let request = Request {
        functions: OUTPUTS.map(of).to_vec(),
        ..request
    };
    generate(robot, &request).unwrap_or_else(|error| panic!("{error}"))
}

/// Against the runtime in both scalars, with arguments for payload and gravity, and with a
/// joint locked.
#[test]
fn rounding_stays_within_the_bound() {
    let robot = with_frames("planar3r");
    let held = with_frames_and("planar3r", "\n[scene.held]\nlock = { 2 = 0.4 }\n");
    let held = dalembert_model::read::parse(&held, &Default::default());
    let scene = held
        .unwrap_or_else(|errors| panic!("{errors}"))
        .scenes
        .pop();
    for request in [
        Request::default(),
        Request {
            parameters: RuntimeParameter::ALL.to_vec(),
            ..Request::default()
        },
        Request {
            scene,
            ..Request::default()
        },
    ] {
        let scene_robot = request.scene_robot(&robot).unwrap();
        let own = generated(&robot, request);
        let states = scene_robot.states(60, 11);
        let runtime = Runtime::in_scene(scene_robot);
        support::rounds_well(&own.emitted, &runtime, &states, "");
    }
}

/// Every language prints them and reads them back, by names of their own; C and CUDA as far
/// as names are short enough for every compiler.
#[test]
fn every_language_has_them() {
    let robot = with_frames("planar2r");
    let functions = [
        "jacobian@camera:local",
        "contact_wrench@camera",
        "operational_inertia@camera",
        "forward_dynamics_with_wrench",
        "task=operational_inertia@elbow:linear+null_space_projector@elbow:linear",
    ]
    .map(of);
    for (language, batch) in [
        (Language::Rust, false),
        (Language::Rust, true),
        (Language::C, false),
        (Language::Cuda, false),
    ] {
        let request = Request {
            language,
            batch,
            module: Some("d".to_owned()),
            scalars: vec![ScalarType::F64],
            ..Request::of(&functions)
        };
        let generated = generate(&robot, &request).unwrap_or_else(|error| panic!("{error}"));
        for function in functions {
            let call = format!("{function}(");
            assert!(generated.text().contains(&call), "{language:?} {function}");
        }
    }
}

#[test]
fn plans_keep_the_frame() {
    let robot = with_frames("planar2r");
    let request = Request {
        scalars: vec![ScalarType::F64],
        ..Request::default()
    };
    let first = generated(&robot, request.clone());
    let request = Request {
        functions: OUTPUTS.map(of).to_vec(),
        ..request
    };
    let text = keep(&robot, &request, &first, None).plan.write();
    assert!(text.contains("\nprogram jacobian@camera:local auto f64 "));
    let plan = Plan::parse(&text).unwrap();
    assert_eq!(plan.write(), text);
    let request = Request {
        plan: Some(plan),
        ..request
    };
    let again = generate(&robot, &request).unwrap();
    assert!(again.functions.iter().all(|function| function.planned));
    assert_eq!(again.text(), first.text());
}

#[test]
fn frames_that_are_not_there_are_refused_by_name() {
    let robot = with_frames("planar2r");
    let said = |robot: &Robot, text: &str| {
        let request = Request::of(&[of(text)]);
        let error = generate(robot, &request).unwrap_err();
        assert!(matches!(error, GenerateError::Frame { .. }));
        error.to_string()
    };
    assert_eq!(
        said(&robot, "jacobian@camra"),
        "`jacobian@camra`: the robot has no frame `camra`: did you mean `camera`?"
    );
    assert_eq!(
        said(&robot, "see=gravity+jacobian@q"),
        "`see=gravity+jacobian@q`: the robot has no frame `q`: it has `hand`, `camera`, `elbow`"
    );
    let none = support::robot("planar2r");
    assert_eq!(
        said(&none, "jacobian@camera:local"),
        "`jacobian@camera:local`: the robot has no frame `camera`: it has `hand`; others are \
         [[frame]] tables of its file"
    );
}

/// A planar arm is singular in three of six components everywhere: without damping there is
/// no Λ, and infinities or no numbers say so; with as little as 1e-9 all is finite. Of the
/// three components that it moves in nothing is singular but where it is stretched out.
#[test]
fn singular_poses_give_no_numbers_without_damping() {
    let robot = with_frames("planar3r");
    let request = Request {
        functions: ["operational_inertia", "operational_inertia@hand:x_y_rz"]
            .map(of)
            .to_vec(),
        scalars: vec![ScalarType::F64],
        ..Request::default()
    };
    let generated = generate(&robot, &request).unwrap();
    let [six, three] = [0, 1].map(|index| &generated.emitted[index]);
    let mut state = seeded(&robot, 1, 5).remove(0);
    let mut finite = |emitted: &Emitted, q: [f64; 3], damping: f64| {
        state.q = q.to_vec();
        *state.of_mut(Argument::Damping) = vec![damping];
        emitted.run(&state).iter().all(|x| x.is_finite())
    };
    let (bent, straight) = ([0.3, -0.8, 1.1], [0.3, 0.0, 0.0]);
    assert!(!finite(six, bent, 0.0) && finite(six, bent, 1e-9));
    assert!(finite(three, bent, 0.0) && finite(three, straight, 1e-9));
}

/// No two keys of given states are one.
#[test]
fn keys_of_states_are_told_apart() {
    let mut known: BTreeMap<&str, Quantity> = BTreeMap::new();
    for &quantity in Quantity::ALL {
        if let Some(key) = quantity.given() {
            assert_eq!(known.insert(key, quantity), None, "{key}");
        }
    }
    for argument in Argument::ALL {
        let key = argument.given().unwrap_or_default();
        assert!(!known.contains_key(key), "{key}");
    }
}
