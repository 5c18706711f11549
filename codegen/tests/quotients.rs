//! Programs that divide: what they divide by, that a wrong divisor is seen, and
//! what is refused by name.

use dalembert_codegen::workspace::{Operand, Operation, Runtime, SEED, SceneRobot, prove, seeded};
use dalembert_codegen::{Function, GenerateError, Program, Request, generate};
use dalembert_model::number::{Angle, Rational};
use dalembert_model::robot::{Position, Robot};
use dalembert_model::scene::{Scale, Scene, Tolerance};

use crate::support;

const INVERTING: [Function; 4] = [
    Function::ForwardDynamics,
    Function::InertiaInverse,
    Function::ForwardDynamicsDerivatives,
    Function::ForwardDynamicsSecondDerivatives,
];

fn program(robot: &Robot, function: Function) -> Program {
    support::one(robot, function).functions.remove(0).program
}

fn quotients(program: &Program) -> Vec<usize> {
    let steps = program.steps.iter().enumerate();
    let quotients = steps.filter(|(_, step)| step.operation == Operation::Div);
    quotients.map(|(index, _)| index).collect()
}

#[test]
fn there_is_a_division_a_joint_at_most() {
    for name in ["planar2r", "planar3r", "stanford", "puma560"] {
        let robot = support::robot(name);
        for function in &INVERTING[..2] {
            let program = program(&robot, *function);
            let divisions = quotients(&program).len();
            assert!(
                (1..=robot.joints.len()).contains(&divisions),
                "{name} {divisions}"
            );
            assert_eq!(program.counts().div, divisions);
        }
    }
}

/// Another divisor, a quotient upside down, a product in its place.
#[test]
fn a_wrong_quotient_is_no_proof() {
    let robot = support::robot("planar3r");
    for function in INVERTING {
        let right = program(&robot, function);
        assert!(prove(&SceneRobot::whole(&robot), &right).is_ok());
        for index in quotients(&right) {
            let mut upside_down = right.clone();
            let step = &mut upside_down.steps[index];
            std::mem::swap(&mut step.left, &mut step.right);
            let mut product = right.clone();
            product.steps[index].operation = Operation::Mul;
            let mut other = right.clone();
            other.steps[index].right = Operand::Step(0);
            for wrong in [upside_down, product, other] {
                assert!(
                    prove(&SceneRobot::whole(&robot), &wrong).is_err(),
                    "{function} t{}",
                    index + 1
                );
            }
        }
    }
}

/// x/x·y is y but where x vanishes; 0/0 is nothing.
#[test]
fn a_divisor_that_is_zero_everywhere_proves_nothing() {
    let robot = support::robot("planar2r");
    let mut wrong = program(&robot, Function::ForwardDynamics);
    let Some(index) = quotients(&wrong).pop() else {
        panic!("forward dynamics divides");
    };
    let step = &mut wrong.steps[index];
    step.right = Operand::Constant("0".parse().unwrap());
    assert!(prove(&SceneRobot::whole(&robot), &wrong).is_err());
}

#[test]
fn an_arm_that_moves_no_inertia_is_refused_by_its_joint() {
    let mut robot = support::robot("planar3r");
    let last = robot.joints.len() - 1;
    let zero = Rational::from_integer(0.into());
    robot.joints[last].mass = zero.clone();
    robot.joints[last].inertia = robot.joints[last].inertia.map(|_| zero.clone());
    for function in INVERTING {
        let request = Request::of(&[function]);
        let Err(error @ GenerateError::Singular { .. }) = generate(&robot, &request) else {
            panic!("{function} of a singular D");
        };
        let text = error.to_string();
        assert!(text.contains(&robot.joint_label(last)), "{text}");
        assert!(text.contains("moves no inertia"), "{text}");
        // Held, it needs none.
        let scene = Scene {
            name: "held".into(),
            lock: vec![(last, Position::Angle(Angle::PiTimes(zero.clone())))],
            ..Scene::default()
        };
        let held = Request {
            scene: Some(scene),
            ..request
        };
        generate(&robot, &held).unwrap_or_else(|error| panic!("{function}: {error}"));
    }
    // Torques that it takes are another matter.
    support::one(&robot, Function::InverseDynamics);
}

#[test]
fn a_tolerance_is_refused_with_what_can_be_certified() {
    let robot = support::robot("planar2r");
    for function in [
        Function::ForwardDynamics,
        Function::InertiaInverse,
        Function::Passivity,
    ] {
        let scene = Scene {
            name: "near".into(),
            tolerance: Some(Tolerance {
                value: vec![Rational::new(1.into(), 100.into())],
                relative_to: Scale::Range,
            }),
            ..Scene::default()
        };
        let request = Request {
            scene: Some(scene),
            ..Request::of(&[function])
        };
        let Err(error) = generate(&robot, &request) else {
            panic!("{function} within a tolerance");
        };
        let text = error.to_string();
        assert!(text.contains(function.name()), "{text}");
        assert!(
            text.contains("give the tolerance to `inverse_dynamics`"),
            "{text}"
        );
    }
}

/// Locked joints, no velocity, rows in another order, both scalars: the rest of
/// the arm moves as the whole one does whose locked joints are held.
#[test]
fn scenes_hold_what_is_locked() {
    let robot = support::robot("planar3r");
    let half = Rational::new(1.into(), 2.into());
    let scene = Scene {
        name: "held".into(),
        joints: Some(vec![2, 0]),
        lock: vec![(1, Position::Angle(Angle::Radians(half)))],
        velocity_zero: true,
        ..Scene::default()
    };
    let request = Request {
        scene: Some(scene.clone()),
        ..Request::of(&INVERTING)
    };
    let generated = generate(&robot, &request).unwrap_or_else(|error| panic!("{error}"));
    let runtime = Runtime::in_scene(SceneRobot::new(&robot, &scene).unwrap());
    let states = seeded(&robot, 100, SEED);
    assert_eq!(generated.emitted.len(), 2 * INVERTING.len());
    support::rounds_well(&generated.emitted, &runtime, &states, "");
}
