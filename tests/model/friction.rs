//! Coulomb friction: its torque by hand, and what it leaves alone. Its slopes are in `outputs`.

use crate::support::{data, ratio, reading, vector, written};
use dalembert_model::outputs::Quantity;
use dalembert_model::reference::{JointVectors, Reference};
use dalembert_model::robot::Robot;
use nalgebra::DVector;

fn robot() -> Robot {
    reading(&data("coulomb.toml")).robot
}

fn without(robot: &Robot) -> Robot {
    let mut robot = robot.clone();
    for joint in &mut robot.joints {
        joint.coulomb = Default::default();
        joint.coulomb_width = Default::default();
    }
    robot
}

fn both() -> [Reference<f64>; 2] {
    [&robot(), &without(&robot())].map(Reference::from_robot)
}

const Q: [f64; 3] = [0.4, 0.1, -1.1];

const FORCES: [f64; 3] = [2.5, 14.0, 0.0];
const WIDTHS: [f64; 3] = [0.01, 1.0 / 300.0, 1.0];

/// Far from rest in both directions, within the widths, and at rest.
const VELOCITIES: [[f64; 3]; 4] = [
    [1.5, -0.8, 2.0],
    [-0.004, 0.002, -0.01],
    [-70.0, 1e-9, 0.0],
    [0.0, 0.0, 0.0],
];

fn by_hand(qd: &[f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| FORCES[i] * qd[i] / qd[i].hypot(WIDTHS[i]))
}

fn close(found: &DVector<f64>, expected: &DVector<f64>) {
    let size = expected.amax().max(1.0);
    let error = (found - expected).amax();
    assert!(error < 1e-12 * size, "{found} {expected}");
}

fn passivity(arm: &Reference<f64>, vectors: [&DVector<f64>; 4]) -> DVector<f64> {
    let arguments = Quantity::Passivity.arguments().iter().copied();
    let at = JointVectors::new(arguments.zip(vectors.map(Clone::clone)));
    DVector::from_vec(arm.entries(Quantity::Passivity, &at).unwrap())
}

/// With v = q̇ and a = q̈ passivity is inverse dynamics.
#[test]
fn the_runtime_has_the_torque_of_the_textbook() {
    let [with, plain] = both();
    let [q, qdd, tau] = [Q, [2.0, -3.0, 5.0], [3.0, -40.0, 0.5]].map(|x| vector(&x));
    for velocities in VELOCITIES {
        let [qd, friction] = [velocities, by_hand(&velocities)].map(|x| vector(&x));
        let [torque, rest] =
            [&with, &plain].map(|arm| arm.inverse_dynamics(&q, &qd, &qdd).unwrap());
        close(&torque, &(&rest + &friction));
        close(&passivity(&with, [&q, &qd, &qd, &qdd]), &torque);
        let acceleration = with.forward_dynamics(&q, &qd, &tau).unwrap();
        let less = plain.forward_dynamics(&q, &qd, &(&tau - &friction));
        close(&acceleration, &less.unwrap());
        let parts = |arm: &Reference<f64>| {
            let d = arm.inertia(&q).unwrap();
            (d, arm.coriolis(&q, &qd).unwrap(), arm.gravity(&q).unwrap())
        };
        assert_eq!(parts(&with), parts(&plain));
    }
}

/// The damping is that of the friction at q̇: with another v it is F v/√(q̇² + w²).
#[test]
fn passivity_takes_friction_as_a_damping() {
    let [with, plain] = both();
    let states = [Q, [0.02, -0.01, 2.0], [-0.3, 0.2, 1.0], [2.0, -3.0, 5.0]];
    let [q, qd, v, a] = states.map(|x| vector(&x));
    let damped = |i: usize| FORCES[i] * v[i] / qd[i].hypot(WIDTHS[i]);
    let rest = passivity(&plain, [&q, &qd, &v, &a]);
    let expected = &rest + &vector(&[0, 1, 2].map(damped));
    close(&passivity(&with, [&q, &qd, &v, &a]), &expected);
}

#[test]
fn files_keep_it() {
    let (robot, plain) = (robot(), without(&robot()));
    let text = written(&robot);
    let lines = "coulomb = 14\ncoulomb_width = \"1/300\"\n";
    assert!(text.contains(lines), "{text}");
    assert_ne!(plain.input_hash(), robot.input_hash());
    assert!(!written(&plain).contains("coulomb_"));
}

#[test]
fn a_width_without_a_force_changes_nothing() {
    let mut idle = without(&robot());
    idle.joints[0].coulomb_width = ratio(1, 2);
    assert_eq!(idle.validate(), []);
    let (q, qd, qdd) = (vector(&Q), vector(&[1.0; 3]), vector(&[2.0; 3]));
    let torques = |arm: &Reference<f64>| arm.inverse_dynamics(&q, &qd, &qdd);
    assert_eq!(torques(&Reference::from_robot(&idle)), torques(&both()[1]));
}
