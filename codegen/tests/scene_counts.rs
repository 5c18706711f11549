//! Scenes of the PUMA: everything they do not need is gone from the code.

use std::path::Path;

use dalembert_codegen::workspace::plan_file;
use dalembert_codegen::{Function, GeneratedFunction, Request, ScalarType, Start, generate};
use dalembert_model::number::{Angle, Rational};
use dalembert_model::robot::Position;
use dalembert_model::scene::{MotionBox, Scene};

use crate::support;

fn locked(joints: &[usize]) -> Vec<(usize, Position)> {
    let at = || Position::Angle(Angle::default());
    joints.iter().map(|joint| (joint - 1, at())).collect()
}

fn puma(scene: Scene, function: Function) -> GeneratedFunction {
    let scene = Scene {
        name: "test".into(),
        ..scene
    };
    let request = Request {
        scalars: vec![ScalarType::F64],
        scene: Some(scene),
        ..Request::of(&[function])
    };
    let robot = support::robot("puma560");
    let generated = generate(&robot, &request).unwrap_or_else(|error| panic!("{error}"));
    let function = generated.functions[0].clone();
    println!("{} {}", function.function, function.counts());
    function
}

/// Bounds are what the quick search finds; it is the same on every machine.
#[test]
fn wrist_locked_at_rest() {
    let scene = Scene {
        lock: locked(&[4, 5, 6]),
        velocity_zero: true,
        joints: Some(vec![0, 1, 2]),
        ..Scene::default()
    };
    let function = puma(scene, Function::InverseDynamics);
    assert!(function.counts().operations() <= 62);
    assert_eq!(function.counts().sincos, 2);
}

#[test]
fn vertical_plane() {
    let scene = Scene {
        lock: locked(&[1, 4, 6]),
        joints: Some(vec![1, 2, 4]),
        ..Scene::default()
    };
    let function = puma(scene, Function::InverseDynamics);
    assert!(function.counts().operations() <= 61);
    assert!(function.counts().sincos <= 3);
}

#[test]
fn gravity_only() {
    let function = puma(Scene::default(), Function::Gravity);
    assert!(function.counts().operations() <= 28);
}

/// A box changes no equation: the plan of the whole robot serves. Standing
/// still does.
#[test]
fn a_box_alone_takes_the_plan_of_the_whole_robot() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../generated/robots/puma560.toml");
    let plan = plan_file::beside(&file).unwrap().unwrap();
    let whole = plan
        .find(
            Function::InverseDynamics,
            Start::Auto,
            ScalarType::F64,
            None,
            None,
        )
        .unwrap();
    let planned = |velocity_zero: bool| {
        let scene = Scene {
            name: "slow".into(),
            velocity_zero,
            bounds: MotionBox {
                velocity: Some(vec![Rational::from_integer(1.into()); 6]),
                ..MotionBox::default()
            },
            ..Scene::default()
        };
        let request = Request {
            scalars: vec![ScalarType::F64],
            scene: Some(scene),
            plan: Some(plan.clone()),
            ..Request::of(&[Function::InverseDynamics])
        };
        generate(&support::robot("puma560"), &request)
            .unwrap_or_else(|error| panic!("{error}"))
            .functions
            .remove(0)
    };
    let slow = planned(false);
    assert!(slow.planned);
    assert_eq!(slow.program, whole.program);
    assert!(!planned(true).planned);
}
