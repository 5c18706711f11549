//! Scenes of the PUMA: everything they do not need is gone from the code.

mod support;

use dalembert_codegen::emit::ScalarType;
use dalembert_codegen::function::Function;
use dalembert_codegen::generate::{GeneratedFunction, Request, generate};
use dalembert_model::number::Angle;
use dalembert_model::robot::Position;
use dalembert_model::scene::Scene;

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
        functions: vec![function],
        scalars: vec![ScalarType::F64],
        scene: Some(scene),
        ..Request::default()
    };
    let robot = support::robot("puma560");
    let generated = generate(&robot, &request).unwrap_or_else(|error| panic!("{error}"));
    let function = generated.functions[0].clone();
    println!("{} {}", function.function, function.counts);
    function
}

#[test]
fn wrist_locked_at_rest() {
    let scene = Scene {
        lock: locked(&[4, 5, 6]),
        velocity_zero: true,
        joints: Some(vec![0, 1, 2]),
        ..Scene::default()
    };
    let function = puma(scene, Function::InverseDynamics);
    assert!(function.counts.operations() <= 170);
    assert_eq!(function.counts.sincos, 2);
}

#[test]
fn vertical_plane() {
    let scene = Scene {
        lock: locked(&[1, 4, 6]),
        joints: Some(vec![1, 2, 4]),
        ..Scene::default()
    };
    let function = puma(scene, Function::InverseDynamics);
    assert!(function.counts.operations() <= 100);
    assert!(function.counts.sincos <= 3);
}

#[test]
fn gravity_only() {
    let function = puma(Scene::default(), Function::Gravity);
    assert!(function.counts.operations() <= 38);
}
