//! A robot whose base floats is identified from its rates, the direction of gravity in its axes, and the
//! torques with the force and the moment on the base.

use dalembert_fit::random::{Random, normal, within};
use dalembert_fit::unexcited::Motion;
use dalembert_fit::{Accumulator, Effort, Model, consistent, excite, fit, identified};
use dalembert_model::equations::Arm;
use dalembert_model::number::Rounded;
use dalembert_model::read::parse;
use dalembert_model::reference::Reference;
use dalembert_model::robot::{Robot, write};
use nalgebra::DVector;

use crate::support::{model, near, number, torques};

fn truth() -> Robot {
    let text = include_str!("../../model/tests/data/two_legs.toml");
    let mut robot = parse(text).unwrap().robot;
    for joint in &mut robot.joints {
        joint.coulomb = number(0.5);
        joint.coulomb_width = number(0.02);
    }
    robot
}

/// The robot as a data sheet has it.
fn guess() -> Robot {
    let mut robot = truth();
    let base = robot.floating.as_mut().unwrap();
    base.mass = &base.mass * &number(1.1);
    base.com[2] = &base.com[2] * &number(0.8);
    for joint in &mut robot.joints {
        joint.mass = &joint.mass * &number(0.9);
        (joint.viscous, joint.coulomb) = (number(0.0), number(0.0));
    }
    robot
}

/// q with gravity behind it, q̇ and q̈.
fn state(model: &Model, random: &mut Random) -> [Vec<f64>; 3] {
    let most = [2.0, 3.0, 10.0];
    let lengths = model.lengths().into_iter().zip(most);
    let mut vectors =
        lengths.map(|(length, most)| (0..length).map(|_| within(random, most)).collect());
    [(); 3].map(|()| vectors.next().unwrap())
}

#[test]
fn parameters_of_the_file_give_its_torques() {
    let (robot, model) = (truth(), model(&truth()));
    assert_eq!((model.joints(), model.coordinates()), (4, 10));
    let arm: Arm<f64> = Arm::from_robot(&robot, &mut f64::nearest);
    let mut random = Random::new(5);
    for _ in 0..20 {
        let [q, qd, qdd] = state(&model, &mut random);
        let gravity = [q[4], q[5], q[6]];
        let reference = Reference::new(arm.clone().with_gravity(&gravity));
        let vector = |values: &[f64]| DVector::from_column_slice(values);
        let wanted = reference.inverse_dynamics(&vector(&q[..4]), &vector(&qd), &vector(&qdd));
        let y = model.regressor(&q, &qd, &qdd).unwrap();
        for (wanted, torque) in wanted.unwrap().iter().zip(torques(&y, model.parameters())) {
            near(torque, *wanted, 1e-10, "two legs");
        }
    }
    let short = model.regressor(&[0.0; 4], &[0.0; 10], &[0.0; 10]);
    let why = short.unwrap_err().to_string();
    assert_eq!(why, "`q` has 4 values instead of 7");
}

/// Standard deviation of each torque, N·m or N.
const NOISE: f64 = 0.05;

fn logged(model: &Model, right: &[f64], noise: f64, seed: u64, moves: bool) -> Accumulator {
    let mut random = Random::new(seed);
    let mut data = Accumulator::new(model);
    for _ in 0..600 {
        let [q, mut qd, mut qdd] = state(model, &mut random);
        if !moves {
            qd[..6].fill(0.0);
            qdd[..6].fill(0.0);
        }
        let y = model.regressor(&q, &qd, &qdd).unwrap();
        let mut tau = torques(&y, right);
        for entry in &mut tau {
            *entry += noise * normal(&mut random);
        }
        data.add(model, [&q, &qd, &qdd], &tau).unwrap();
    }
    data
}

#[test]
fn the_base_and_the_links_are_identified() {
    let (right, model) = (model(&truth()), model(&guess()));
    let exact = fit(&model, &logged(&model, right.parameters(), 0.0, 6, true)).unwrap();
    assert!(exact.unexcited.is_empty(), "{:?}", exact.unexcited);
    for (k, wanted) in right.parameters().iter().enumerate() {
        near(exact.parameters[k], *wanted, 1e-8, &model.name(k));
    }
    let data = logged(&model, right.parameters(), NOISE, 8, true);
    let fit = fit(&model, &data).unwrap();
    let bodies = consistent(&model, &fit).unwrap();
    assert_eq!(bodies.links.len(), 5);
    let text = write(&identified(&model, &bodies).unwrap());
    let again = crate::support::model(&parse(&text).unwrap().robot);
    assert_eq!(again.fingerprint(), model.fingerprint());
    for (k, wanted) in bodies.parameters.iter().enumerate() {
        let name = model.name(k);
        if !name.starts_with("offset") {
            near(again.parameters()[k], *wanted, 1e-9, &name);
        }
    }
    for residual in data.residual(&model, &bodies.parameters).unwrap() {
        assert!((0.8..1.15).contains(&(residual / NOISE)), "{residual}");
    }
    // The first base parameter is the mass of all bodies.
    assert!(model.name(0).starts_with("m0 + m1"), "{}", model.name(0));
    near(bodies.parameters[0], 13.9, 1e-2, "the mass of all bodies");
    // The bytes are read again.
    let read = Accumulator::from_bytes(&model, &data.to_bytes()).unwrap();
    assert_eq!(read.states(), 600);
}

/// A robot that hangs still says nothing of moments about axes: the base has to turn.
#[test]
fn what_needs_the_base_to_move_is_told() {
    let model = model(&guess());
    let data = logged(&model, model.parameters(), 0.0, 7, false);
    let fit = fit(&model, &data).unwrap();
    assert!(!fit.unexcited.is_empty());
    for direction in &fit.unexcited {
        assert_eq!(direction.motion, Motion::Base, "{direction}");
    }
    let why = excite(&model, &[1.0; 10], 5.0, &Effort::default()).unwrap_err();
    assert!(why.to_string().contains("a base that floats"), "{why}");
}
