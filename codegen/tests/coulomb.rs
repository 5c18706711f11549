//! Coulomb friction in what is generated: proved with each 1/√(q̇² + w²) as a variable,
//! its torque by hand, scenes that drop it, texts that say something else, and what is
//! refused.

use crate::support;
use crate::support::draw::Draw;
use dalembert_codegen::workspace::{
    BOUND, Disproof, Emitted, JointState, Library, Lowered, Random, Runtime, RuntimeParameter,
    SceneRobot, keep, prove,
};
use dalembert_codegen::{Function, Generated, Plan, Request, ScalarType, SinCos, Start, generate};
use dalembert_model::equations::Formulation;
use dalembert_model::number::Rational;
use dalembert_model::read::{self, Reading};
use dalembert_model::robot::Robot;

const ARM: &str = include_str!("../../model/tests/data/coulomb.toml");
/// Of the arm, whose last joint has none.
const FORCES: [f64; 3] = [2.5, 14.0, 0.0];
const WIDTHS: [f64; 3] = [0.01, 1.0 / 300.0, 1.0];

/// Whatever friction is in, and what it is not in.
const RUBBED: [Function; 7] = [
    Function::InverseDynamics,
    Function::Passivity,
    Function::ForwardDynamics,
    Function::InverseDynamicsDerivatives,
    Function::ForwardDynamicsDerivatives,
    Function::InverseDynamicsSecondDerivatives,
    Function::ForwardDynamicsSecondDerivatives,
];
const PLAIN: [Function; 6] = [
    Function::Coriolis,
    Function::ManipulatorEquation,
    Function::DynamicCoefficients,
    Function::KineticEnergy,
    Function::InertiaInverse,
    Function::ReactionWrenches,
];

fn reading(scenes: &str) -> Reading {
    let source = format!("{ARM}\n{scenes}");
    read::parse(&source, &read::Options::default()).unwrap_or_else(|errors| panic!("{errors}"))
}

fn arm() -> Robot {
    reading("").robot
}

fn without(robot: &Robot) -> Robot {
    let mut robot = robot.clone();
    for joint in &mut robot.joints {
        joint.coulomb = Rational::default();
    }
    robot
}

fn request(functions: &[Function]) -> Request {
    Request::of(functions)
}

fn of(robot: &Robot, request: &Request) -> Generated {
    generate(robot, request).unwrap_or_else(|error| panic!("{error}"))
}

fn in_f64(generated: &Generated, function: Function) -> &Emitted {
    let mut emitted = generated.emitted.iter();
    let is = |e: &&Emitted| e.function == function && e.scalar == ScalarType::F64;
    emitted.find(is).unwrap()
}

/// Returns where friction has its full force, where it is within its width, and at rest.
fn states(scene_robot: &SceneRobot, count: usize) -> Vec<JointState> {
    let mut states = scene_robot.states(count, 0x636f_756c);
    for (index, state) in states.iter_mut().enumerate() {
        let factor = [1.0, 1e-2, 1e-4, 0.0][index % 4];
        state.qd.iter_mut().for_each(|qd| *qd *= factor);
    }
    states
}

/// Every function in f64 and f32 against the runtime, also where the velocity is of
/// the size of the width.
#[test]
fn code_is_as_accurate_as_without() {
    let robot = arm();
    let functions = [&RUBBED[..], &PLAIN].concat();
    let generated = of(&robot, &request(&functions));
    let scene_robot = SceneRobot::whole(&robot);
    let (states, runtime) = (states(&scene_robot, 200), Runtime::new(&robot));
    assert_eq!(generated.emitted.len(), 2 * functions.len());
    support::rounds_well(&generated.emitted, &runtime, &states, "");
    for function in &generated.functions {
        let rubbed = RUBBED.contains(&function.function);
        assert_eq!(function.counts().sqrt > 0, rubbed, "{}", function.function);
    }
}

/// The torques beside those of the arm without, in all velocities; forward dynamics
/// takes them of τ, passivity has them of v.
#[test]
fn torques_are_those_of_the_textbook() {
    let robot = arm();
    let functions = &RUBBED[..3];
    let [with, plain] = [&robot, &without(&robot)].map(|robot| of(robot, &request(functions)));
    for state in states(&SceneRobot::whole(&robot), 100) {
        let friction = |v: &[f64]| -> Vec<f64> {
            let smoothed = (0..3).map(|i| FORCES[i] * v[i] / state.qd[i].hypot(WIDTHS[i]));
            smoothed.collect()
        };
        let close = |function, own: &[f64], other: &[f64]| {
            let size = other.iter().fold(1.0, |most: f64, x| most.max(x.abs()));
            for (own, other) in own.iter().zip(other) {
                assert!(
                    (own - other).abs() < 1e-12 * size,
                    "{function} at {state:?}"
                );
            }
        };
        for (function, v) in [(functions[0], &state.qd), (functions[1], &state.v)] {
            let rest = in_f64(&plain, function).run(&state);
            let sum = rest.iter().zip(friction(v)).map(|(x, f)| x + f);
            let sum: Vec<f64> = sum.collect();
            close(function, &in_f64(&with, function).run(&state), &sum);
        }
        let mut less = state.clone();
        for (tau, f) in less.tau.iter_mut().zip(friction(&state.qd)) {
            *tau -= f;
        }
        let expected = in_f64(&plain, functions[2]).run(&less);
        let found = in_f64(&with, functions[2]).run(&state);
        close(functions[2], &found, &expected);
    }
}

/// From every formulation the same, proved; the arithmetic is not the same.
#[test]
fn every_formulation_has_it() {
    let robot = arm();
    let (states, runtime) = (states(&SceneRobot::whole(&robot), 20), Runtime::new(&robot));
    for formulation in [Formulation::LagrangeEuler, Formulation::NewtonEulerLink] {
        let request = Request {
            start: Start::Only(formulation),
            ..request(&RUBBED)
        };
        let own = of(&robot, &request).emitted;
        support::rounds_well(&own, &runtime, &states, formulation);
    }
}

/// Robots that nobody chose, both conventions: what reads friction is proved of each,
/// and h, which must not.
#[test]
fn random_robots_are_proved() {
    let mut draw = Draw(Random::new(0x636f_756c));
    for _ in 0..if cfg!(debug_assertions) { 4 } else { 40 } {
        let mut robot = draw.robot(3);
        for joint in &mut robot.joints {
            if !draw.chance(3) {
                joint.coulomb = draw.milli(1, 20_000);
                joint.coulomb_width = draw.milli(1, 100);
            }
        }
        let (states, runtime) = (states(&SceneRobot::whole(&robot), 40), Runtime::new(&robot));
        let functions = [&RUBBED[..3], &PLAIN[..1]].concat();
        let own = of(&robot, &request(&functions)).emitted;
        support::rounds_well(&own, &runtime, &states, &robot);
    }
}

const SCENES: &str = "
[scene.still]
velocity = \"zero\"
[scene.held]
lock = { waist = 0.4 }
joints = [\"slide\", \"wrist\"]
";

/// A joint that does not move has no friction, but its slope where it is at rest:
/// F/w + b.
#[test]
fn scenes_drop_what_does_not_move() {
    let Reading { robot, scenes, .. } = reading(SCENES);
    for scene in &scenes {
        let request = Request {
            scene: Some(scene.clone()),
            ..request(&RUBBED)
        };
        let generated = of(&robot, &request);
        let scene_robot = request.scene_robot(&robot).unwrap();
        let states = states(&scene_robot, 40);
        let runtime = Runtime::in_scene(scene_robot);
        support::rounds_well(&generated.emitted, &runtime, &states, &scene.name);
        let text = &generated.text();
        match scene.name.as_str() {
            "still" => {
                assert!(!text.contains("sqrt"), "{text}");
                let slopes = in_f64(&generated, Function::InverseDynamicsDerivatives);
                let slopes = &slopes.run(&states[0])[9..18];
                let expected = [2.5 / 0.01 + 0.3, 14.0 * 300.0, 0.05];
                for (i, expected) in expected.into_iter().enumerate() {
                    assert!((slopes[4 * i] - expected).abs() < 1e-10 * expected);
                }
            }
            _ => {
                assert!(
                    text.contains("let r2 = ") && !text.contains("let r1 = "),
                    "{text}"
                );
            }
        }
    }
}

/// The root stands where the arithmetic does, by the library of the sines; in columns once more,
/// by the crate of batches.
#[test]
fn roots_are_printed_once() {
    let robot = arm();
    for (sincos, path) in [
        (SinCos::Libm, "libm"),
        (SinCos::Together, "dalembert_sines"),
    ] {
        for batch in [false, true] {
            let request = Request {
                sincos,
                batch,
                ..request(&RUBBED[..1])
            };
            let text = of(&robot, &request).text();
            for line in [
                format!("    let r1 = 1.0 / {path}::sqrt(qd[0] * qd[0] + 0.0001);\n"),
                format!("    let r2 = 1.0 / {path}::sqrtf(qd[1] * qd[1] + 1.1111111e-5);\n"),
            ] {
                assert_eq!(text.matches(&line).count(), 1, "{batch}: {line}\n{text}");
            }
        }
    }
}

/// Every word of the line counts.
#[test]
fn another_line_is_another_program() {
    let robot = arm();
    let generated = of(&robot, &request(&RUBBED[..1]));
    let function = &generated.functions[0];
    let parse = |text: &str| Lowered::parse(text, function.function, ScalarType::F64);
    let line = "let r1 = 1.0 / libm::sqrt(qd[0] * qd[0] + 0.0001);";
    assert!(generated.text().contains(line), "{}", generated.text());
    let own = parse(&generated.text()).unwrap();
    assert_eq!(own.matches(&function.program, Library::Libm, &[]), Ok(()));
    for other in [
        "let r1 = 1.0 / libm::sqrt(qd[0] * qd[0] + 0.0002);",
        "let r1 = 1.0 / libm::sqrt(qd[0] * qd[0] + 0.0001 + 0.0);",
        "let r1 = 1.0 / libm::sqrt(qd[0] * qd[0] - 0.0001);",
        "let r1 = 1.0 / libm::sqrt(qd[0] * qd[1] + 0.0001);",
        "let r1 = 1.0 / libm::sqrt(qd[1] * qd[1] + 0.0001);",
        "let r1 = 1.0 / libm::sqrt(qdd[0] * qdd[0] + 0.0001);",
        "let r1 = 1.0 / libm::sqrtf(qd[0] * qd[0] + 0.0001);",
        "let r1 = 1.0 / libm::cbrt(qd[0] * qd[0] + 0.0001);",
        "let r1 = 2.0 / libm::sqrt(qd[0] * qd[0] + 0.0001);",
        "let r1 = libm::sqrt(qd[0] * qd[0] + 0.0001);",
        "let r1 = 1.0 / libm::sqrt(qd[0]);",
        "let r3 = 1.0 / libm::sqrt(qd[0] * qd[0] + 0.0001);",
        "",
    ] {
        let text = generated.text().replacen(line, other, 1);
        let is_same = |read: Lowered| {
            let same = read.matches(&function.program, Library::Libm, &[]);
            same.is_ok()
        };
        assert!(!parse(&text).is_ok_and(is_same), "{other}");
    }
}

/// A program with other widths is none of the arm's, nor is one whose friction is
/// of another joint.
#[test]
fn proofs_are_of_the_robots_widths() {
    let robot = arm();
    let generated = of(&robot, &request(&RUBBED[..1]));
    let scene_robot = SceneRobot::whole(&robot);
    let program = &generated.functions[0].program;
    assert!(prove(&scene_robot, program).is_ok());
    let mut wider = robot.clone();
    wider.joints[0].coulomb_width = Rational::new(1.into(), 50.into());
    assert_eq!(
        prove(&SceneRobot::whole(&wider), program),
        Err(Disproof::Shape)
    );
    let mut stronger = robot.clone();
    stronger.joints[0].coulomb = Rational::new(13.into(), 5.into());
    let wrong = prove(&SceneRobot::whole(&stronger), program);
    assert!(
        matches!(wrong, Err(Disproof::Output { index: 0, .. })),
        "{wrong:?}"
    );
}

/// What a plan keeps is proved and printed as it was.
#[test]
fn plans_keep_it() {
    let robot = arm();
    let mut wanted = request(&RUBBED[..1]);
    let first = of(&robot, &wanted);
    let text = keep(&robot, &wanted, &first, None).plan.write();
    let has = |root| {
        text.lines()
            .any(|line| line.split(' ').any(|word| word == root))
    };
    assert!(has("r1") && has("r2"), "{text}");
    wanted.plan = Some(Plan::parse(&text).unwrap());
    let again = of(&robot, &wanted);
    assert!(again.functions[0].planned);
    assert_eq!(again.functions[0].program, first.functions[0].program);
}

/// Payload and gravity as arguments, with friction beside them.
#[test]
fn arguments_go_with_it() {
    let robot = arm();
    let request = Request {
        parameters: RuntimeParameter::ALL.to_vec(),
        ..request(&RUBBED[..1])
    };
    let generated = of(&robot, &request);
    let scene_robot = request.scene_robot(&robot).unwrap();
    let states = states(&scene_robot, 40);
    let runtime = Runtime::in_scene(scene_robot);
    let load = in_f64(&generated, Function::Load);
    let torques = in_f64(&generated, Function::InverseDynamics);
    for mut state in states {
        state.load = load.run(&state);
        for measure in torques.against_runtime(&runtime, &[state]) {
            assert!(measure.in_units() < BOUND, "{measure:?}");
        }
    }
}

/// What has no answer with friction says so, why, and the way around.
#[test]
fn what_cannot_be_is_refused_by_name() {
    let limits = "velocity = 2, acceleration = 9, torque = 90";
    let source = ARM.replace(
        "mass =",
        &format!("limits = {{ position = [-1, 1], {limits} }}\nmass ="),
    );
    let tolerance = "\n[scene.roughly]\ntolerance = { value = 0.1, relative_to = \"actuator\" }\n";
    let found = read::parse(&(source + tolerance), &read::Options::default());
    let Reading { robot, scenes, .. } = found.unwrap_or_else(|errors| panic!("{errors}"));
    let refusal = |request: &Request| match generate(&robot, request) {
        Ok(_) => panic!("generated"),
        Err(error) => error.to_string(),
    };
    let roughly = |function| Request {
        scene: Some(scenes[0].clone()),
        ..request(&[function])
    };
    let why = refusal(&roughly(Function::InverseDynamics));
    let words = [
        "`inverse_dynamics`",
        "Coulomb friction",
        "no certified bound",
        "leave `coulomb` out",
    ];
    for words in words {
        assert!(why.contains(words), "{why}");
    }
    for function in [Function::Regressor, Function::PassivityRegressor] {
        let why = refusal(&request(&[function]));
        let name = format!("`{function}`");
        for words in [
            name.as_str(),
            "not linear",
            "leave `coulomb` out",
            "`full_regressor`",
        ] {
            assert!(why.contains(words), "{why}");
        }
    }
    // Inside all limits nothing overflows.
    assert_eq!(of(&robot, &request(&RUBBED[..1])).warnings, [""; 0]);
    // What has no friction in it is none of this.
    let rough = of(&robot, &roughly(Function::Gravity));
    let admitted = rough.functions[0].admitted.as_ref().unwrap();
    assert!(!admitted.certificates.is_empty());
    let full = of(&robot, &request(&[Function::FullRegressor]));
    assert!(
        full.text()
            .contains("Armature and friction, viscous and Coulomb, have none.")
    );
}
