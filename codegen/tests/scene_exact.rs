//! A scene's code is the full model's at the scene's values: proved, and run.

use dalembert_codegen::workspace::{
    Argument, Disproof, Input, Operand, Runtime, SceneRobot, keep, prove, seeded,
};
use dalembert_codegen::{
    Function, GenerateError, Generated, Plan, Program, Request, ScalarType, generate,
};
use dalembert_model::number::{Angle, Rational};
use dalembert_model::outputs::Axis;
use dalembert_model::robot::{Position, Robot};
use dalembert_model::scene::{Payload, Scene};

use crate::support;

fn ratio(numerator: i64, denominator: i64) -> Rational {
    Rational::new(numerator.into(), denominator.into())
}

fn pi_times(numerator: i64, denominator: i64) -> Position {
    Position::Angle(Angle::PiTimes(ratio(numerator, denominator)))
}

fn radians(numerator: i64, denominator: i64) -> Position {
    Position::Angle(Angle::Radians(ratio(numerator, denominator)))
}

fn named(scene: Scene) -> Scene {
    Scene {
        name: "test".into(),
        ..scene
    }
}

fn request(scene: &Scene, functions: &[Function]) -> Request {
    Request {
        scalars: vec![ScalarType::F64],
        scene: Some(scene.clone()),
        ..Request::of(functions)
    }
}

fn run(robot: &Robot, scene: &Scene, functions: &[Function]) -> Generated {
    generate(robot, &request(scene, functions)).unwrap_or_else(|error| panic!("{error}"))
}

/// Compares the scene's text against the runtime of the whole robot, at states that have the
/// scene's values; nothing here goes through [`SceneRobot`].
fn check_floats(robot: &Robot, scene: &Scene, generated: &Generated) {
    let whole = Runtime::new(&scene.apply(robot));
    let rows = scene.rows(robot.joints.len());
    let n = robot.joints.len();
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
            // Locked entries must not be read.
            let mut noisy = state.clone();
            for (joint, _) in &scene.lock {
                noisy.q[*joint] = f64::NAN;
                noisy.qd[*joint] = f64::NAN;
                noisy.qdd[*joint] = f64::NAN;
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
                        Axis::Fixed(_)
                        | Axis::LinkParameters
                        | Axis::BaseParameters
                        | Axis::Load => {
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
}

#[test]
fn locked_scenes_are_the_full_model() {
    let some = [
        Function::InverseDynamics,
        Function::Gravity,
        Function::ManipulatorEquation,
    ];
    let lock = |lock: Vec<(usize, Position)>| {
        named(Scene {
            lock,
            ..Scene::default()
        })
    };
    for (robot, scenes) in [
        (
            "puma560",
            vec![
                lock(vec![
                    (3, pi_times(0, 1)),
                    (4, pi_times(1, 2)),
                    (5, radians(1, 3)),
                ]),
                lock(vec![
                    (0, radians(1, 2)),
                    (3, pi_times(1, 1)),
                    (5, pi_times(1, 6)),
                ]),
                lock(vec![(1, pi_times(-1, 4)), (2, pi_times(1, 4))]),
            ],
        ),
        (
            "stanford",
            vec![
                lock(vec![(2, Position::Length(ratio(1, 2)))]),
                lock(vec![
                    (0, pi_times(0, 1)),
                    (1, pi_times(1, 2)),
                    (4, radians(-3, 10)),
                ]),
            ],
        ),
        (
            "panda",
            vec![lock(vec![
                (0, pi_times(0, 1)),
                (2, pi_times(1, 2)),
                (4, pi_times(0, 1)),
                (6, pi_times(1, 4)),
            ])],
        ),
    ] {
        let robot = support::robot(robot);
        for scene in scenes {
            let generated = run(&robot, &scene, &some);
            check_floats(&robot, &scene, &generated);
            for function in &generated.functions {
                let locked = |joint: usize| scene.locked(joint).is_some();
                assert!(!reads(&function.program, locked), "{}", function.function);
            }
        }
    }
}

/// Returns whether a program reads anything of some joints.
fn reads(program: &Program, joint: impl Fn(usize) -> bool) -> bool {
    let steps = program.steps.iter().flat_map(|s| [&s.left, &s.right]);
    let outputs = program.outputs.iter().map(|output| &output.value);
    steps.chain(outputs).any(|operand| match operand {
        Operand::Input(Input::Sin(angle) | Input::Cos(angle)) => {
            angle.terms().any(|(i, _)| joint(i))
        }
        Operand::Input(
            Input::Entry(Argument::Position, i)
            | Input::Entry(Argument::Velocity, i)
            | Input::Entry(Argument::Acceleration, i),
        ) => joint(*i),
        _ => false,
    })
}

#[test]
fn every_function_over_chosen_joints() {
    let robot = support::robot("planar3r");
    let payload = Payload {
        mass: ratio(5, 2),
        com: [ratio(1, 20), ratio(0, 1), ratio(1, 10)],
        inertia: Default::default(),
    };
    for scene in [
        Scene {
            joints: Some(vec![2, 0]),
            payload: Some(payload.clone()),
            ..Scene::default()
        },
        Scene {
            lock: vec![(1, pi_times(1, 3))],
            gravity: Some([ratio(1, 1), ratio(-3, 1), ratio(1, 2)]),
            acceleration_zero: true,
            ..Scene::default()
        },
        // The torque that a brake holds.
        Scene {
            joints: Some(vec![1, 0]),
            lock: vec![(1, pi_times(1, 3)), (2, pi_times(1, 2))],
            velocity_zero: true,
            payload: Some(payload),
            ..Scene::default()
        },
    ] {
        let scene = named(scene);
        let generated = run(&robot, &scene, &Function::ALL[..6]);
        check_floats(&robot, &scene, &generated);
    }
}

#[test]
fn the_text_says_what_is_left() {
    let robot = support::robot("puma560");
    let scene = named(Scene {
        lock: (3..6).map(|joint| (joint, pi_times(0, 1))).collect(),
        velocity_zero: true,
        ..Scene::default()
    });
    let functions = [Function::InverseDynamics, Function::Inertia];
    let text = run(&robot, &scene, &functions).text();
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

/// The proof is against the full model at the scene's values: another value,
/// another payload, or rows in another order are no match.
#[test]
fn another_scene_disproves() {
    let robot = support::robot("puma560");
    let scene = |angle: Position, mass: i64| {
        named(Scene {
            joints: Some(vec![0, 1]),
            lock: vec![(2, angle)],
            payload: Some(Payload {
                mass: ratio(mass, 1),
                com: [ratio(0, 1), ratio(0, 1), ratio(1, 20)],
                inertia: Default::default(),
            }),
            ..Scene::default()
        })
    };
    let own = scene(pi_times(1, 2), 2);
    let generated = run(&robot, &own, &[Function::Gravity]);
    let program = &generated.functions[0].program;
    let proved = |scene: &Scene| {
        let scene_robot = SceneRobot::new(&robot, scene).unwrap_or_else(|error| panic!("{error}"));
        prove(&scene_robot, program)
    };
    assert!(proved(&own).is_ok());
    for other in [scene(pi_times(1, 3), 2), scene(pi_times(1, 2), 3)] {
        assert!(matches!(proved(&other), Err(Disproof::Output { .. })));
    }
    let turned = Scene {
        joints: Some(vec![1, 0]),
        ..own
    };
    assert_eq!(proved(&turned), Err(Disproof::Shape));
}

#[test]
fn plans_tell_scenes_apart() {
    let robot = support::robot("planar3r");
    let scene = named(Scene {
        joints: Some(vec![1, 0]),
        lock: vec![(2, pi_times(1, 2))],
        velocity_zero: true,
        ..Scene::default()
    });
    let mut wanted = request(&scene, &[Function::InverseDynamics]);
    let first = generate(&robot, &wanted).unwrap_or_else(|error| panic!("{error}"));
    let kept = keep(&robot, &wanted, &first, None).plan;
    let read = Plan::parse(&kept.write()).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(read, kept);
    wanted.plan = Some(read);
    let again = generate(&robot, &wanted).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(again.text(), first.text());
    // Not the whole robot's.
    let whole = Request {
        scene: None,
        ..wanted.clone()
    };
    let whole = generate(&robot, &whole).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(whole.functions[0].program.rows, [0, 1, 2]);
    // Nor that of the scene as it is now.
    wanted.scene = Some(Scene {
        lock: vec![(2, pi_times(1, 3))],
        ..scene
    });
    let stale = generate(&robot, &wanted).map(|generated| generated.text());
    let stale = stale.expect_err("the plan is of the scene as it was");
    assert_eq!(
        stale,
        GenerateError::StaleScene {
            scene: "test".into()
        }
    );
    assert!(stale.to_string().contains("the scene `test`"), "{stale}");
}

#[test]
fn a_scene_of_another_robot_is_refused() {
    let robot = support::robot("planar2r");
    let scene = named(Scene {
        joints: Some(vec![0, 4]),
        ..Scene::default()
    });
    let error = generate(&robot, &request(&scene, &[Function::Gravity]))
        .map(|generated| generated.text())
        .expect_err("has two joints");
    assert!(error.to_string().contains("there is no joint 5"), "{error}");
}
