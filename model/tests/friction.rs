//! Coulomb friction: its torque by hand, its slopes by differences of 76 digits, and
//! what it leaves alone.

use dalembert_model::number::Rational;
use dalembert_model::outputs::Quantity;
use dalembert_model::read::{Options, parse};
use dalembert_model::reference::{JointVectors, Reference};
use dalembert_model::robot::{Robot, write};
use nalgebra::DVector;

fn robot() -> Robot {
    let source = include_str!("data/coulomb.toml");
    parse(source, &Options::default()).unwrap().robot
}

fn without(robot: &Robot) -> Robot {
    let mut robot = robot.clone();
    for joint in &mut robot.joints {
        joint.coulomb = Rational::default();
        joint.coulomb_width = Rational::default();
    }
    robot
}

fn vector(values: [f64; 3]) -> DVector<f64> {
    DVector::from_column_slice(&values)
}

/// What it is, the keys of the file apart.
const FORCES: [f64; 3] = [2.5, 14.0, 0.0];
const WIDTHS: [f64; 3] = [0.01, 1.0 / 300.0, 1.0];

/// Far from rest in both directions, within the widths, and at rest.
const VELOCITIES: [[f64; 3]; 4] = [
    [1.5, -0.8, 2.0],
    [-0.004, 0.002, -0.01],
    [-70.0, 1e-9, 0.0],
    [0.0, 0.0, 0.0],
];

/// Returns F q̇/√(q̇² + w²) by the platform's own hypotenuse.
fn by_hand(qd: &[f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| FORCES[i] * qd[i] / qd[i].hypot(WIDTHS[i]))
}

fn close(found: &DVector<f64>, expected: &DVector<f64>) {
    let size = expected.amax().max(1.0);
    let error = (found - expected).amax();
    assert!(error < 1e-12 * size, "{found} {expected}");
}

fn passivity(arm: &Reference<f64>, [q, qd, v, a]: [&DVector<f64>; 4]) -> DVector<f64> {
    let rest = || DVector::zeros(3);
    let at = JointVectors::new([q.clone(), qd.clone(), rest(), rest(), v.clone(), a.clone()]);
    DVector::from_vec(arm.entries(Quantity::Passivity, &at).unwrap())
}

/// τ has it beside everything else, and τ with it moves the arm as τ without it
/// does; with v = q̇ and a = q̈ passivity is inverse dynamics.
#[test]
fn the_runtime_has_the_torque_of_the_textbook() {
    let (with, plain) = (robot(), without(&robot()));
    let [with, plain] = [&with, &plain].map(Reference::<f64>::from_robot);
    let (q, qdd) = (vector([0.4, 0.1, -1.1]), vector([2.0, -3.0, 5.0]));
    for velocities in VELOCITIES {
        let (qd, friction) = (vector(velocities), vector(by_hand(&velocities)));
        let tau = with.inverse_dynamics(&q, &qd, &qdd).unwrap();
        let rest = plain.inverse_dynamics(&q, &qd, &qdd).unwrap();
        close(&tau, &(&rest + &friction));
        close(&passivity(&with, [&q, &qd, &qd, &qdd]), &tau);
        let tau = vector([3.0, -40.0, 0.5]);
        let found = with.forward_dynamics(&q, &qd, &tau).unwrap();
        let less = plain.forward_dynamics(&q, &qd, &(&tau - &friction));
        close(&found, &less.unwrap());
        // What is none of τ has no friction in it.
        let parts = |arm: &Reference<f64>| {
            let d = arm.inertia(&q).unwrap();
            (d, arm.coriolis(&q, &qd).unwrap(), arm.gravity(&q).unwrap())
        };
        assert_eq!(parts(&with), parts(&plain));
    }
}

/// Passivity takes the damping that the friction is at q̇, and of v the whole: with
/// another v it is F v/√(q̇² + w²).
#[test]
fn passivity_takes_friction_as_a_damping() {
    let (with, plain) = (robot(), without(&robot()));
    let [with, plain] = [&with, &plain].map(Reference::<f64>::from_robot);
    let [q, qd, v, a] = [
        [0.4, 0.1, -1.1],
        [0.02, -0.01, 2.0],
        [-0.3, 0.2, 1.0],
        [2.0, -3.0, 5.0],
    ]
    .map(vector);
    let damped = |i: usize| FORCES[i] * v[i] / qd[i].hypot(WIDTHS[i]);
    let rest = passivity(&plain, [&q, &qd, &v, &a]);
    let expected = &rest + &vector(std::array::from_fn(damped));
    close(&passivity(&with, [&q, &qd, &v, &a]), &expected);
}

/// The written file is read back as the same robot, and a robot without friction has
/// the text, and so the hash, that it had.
#[test]
fn files_keep_it() {
    let robot = robot();
    let text = write(&robot);
    assert!(
        text.contains("coulomb = 14\ncoulomb_width = \"1/300\"\n"),
        "{text}"
    );
    assert_eq!(parse(&text, &Options::default()).unwrap().robot, robot);
    let plain = without(&robot);
    assert_ne!(plain.input_hash(), robot.input_hash());
    assert!(!write(&plain).contains("coulomb_"));
}

/// A width alone is none: there is nothing that it smooths.
#[test]
fn a_width_without_a_force_changes_nothing() {
    let (mut idle, plain) = (without(&robot()), without(&robot()));
    idle.joints[0].coulomb_width = Rational::new(1.into(), 2.into());
    assert_eq!(idle.validate(), []);
    let [idle, plain] = [&idle, &plain].map(Reference::<f64>::from_robot);
    let (q, qd, qdd) = (vector([0.4, 0.1, -1.1]), vector([1.0; 3]), vector([2.0; 3]));
    assert_eq!(
        idle.inverse_dynamics(&q, &qd, &qdd),
        plain.inverse_dynamics(&q, &qd, &qdd)
    );
}

mod slopes {
    use dalembert_model::equations::{Arm, Formulation, JointPosition};
    use dalembert_model::number::parse::parse_decimal;
    use dalembert_model::number::{Angle, Wide};
    use dalembert_model::robot::JointKind;
    use dalembert_model::scalar::{Divide, Scalar};

    fn wide(text: &str) -> Wide {
        Wide::from_rational(&parse_decimal(text).unwrap())
    }

    /// Returns the arm at a velocity.
    fn at_speed(qd: &[Wide]) -> Arm<Wide> {
        let arm = Arm::from_robot(&super::robot(), &mut Wide::from_exact);
        let speeds = arm.links.iter().zip(qd);
        let speeds = speeds.map(|(link, qd)| link.friction.per_speed(qd, Wide::sqrt));
        let speeds: Vec<Option<Wide>> = speeds.collect();
        arm.at_speeds(&speeds)
    }

    fn differ(found: &[Vec<Wide>], expected: &[Vec<Wide>]) -> f64 {
        let pairs = found.iter().flatten().zip(expected.iter().flatten());
        pairs.fold(0.0, |most: f64, (found, expected)| {
            most.max(found.sub(expected).magnitude())
        })
    }

    /// ∂τ/∂q̇ and ∂q̈/∂q̇ of all formulations are what τ and q̈ change by: central
    /// differences over 2e-25, of which the rest is of the third derivative, below
    /// 1e-41 here, and the digits lost are 25 of 76.
    #[test]
    fn slopes_are_differences() {
        let position = [("0.4", true), ("0.1", false), ("-1.1", true)];
        let (step, twice) = (wide("1e-25"), wide("2e-25"));
        for velocities in super::VELOCITIES {
            let qd = velocities.map(|x| Wide::from_f64(x).unwrap());
            let arm = at_speed(&qd);
            let q = position.map(|(q, turns)| match turns {
                true => {
                    let angle = Angle::Radians(parse_decimal(q).unwrap());
                    JointPosition::Revolute(Wide::sincos(&angle))
                }
                false => JointPosition::Prismatic(wide(q)),
            });
            assert_eq!(arm.links[1].kind, JointKind::Prismatic);
            let at = arm.at(&q);
            let [qdd, tau] = [["2", "-3", "5"], ["3", "-40", "0.5"]].map(|x| x.map(wide));
            let moves = [true; 3];
            for form in Formulation::ALL {
                let results = |qd: &[Wide; 3]| {
                    let arm = at_speed(qd);
                    let tau_of = form.inverse_dynamics(&arm, &at, qd, &qdd);
                    [tau_of, form.forward_dynamics(&arm, &at, qd, &tau, &moves)]
                };
                let found = [
                    form.torque_by_velocity(&arm, &at, &qd),
                    form.acceleration_slopes(&arm, &at, &qd, &tau, &moves)[1].clone(),
                ];
                let mut expected = [(); 2].map(|()| vec![vec![Wide::zero(); 3]; 3]);
                for k in 0..3 {
                    let (mut more, mut less) = (qd, qd);
                    (more[k], less[k]) = (qd[k].add(&step), qd[k].sub(&step));
                    let pairs = results(&more).into_iter().zip(results(&less));
                    for (rows, (more, less)) in expected.iter_mut().zip(pairs) {
                        for (i, row) in rows.iter_mut().enumerate() {
                            row[k] = Divide::div(&more[i].sub(&less[i]), &twice);
                        }
                    }
                }
                for (found, expected) in found.iter().zip(&expected) {
                    let error = differ(found, expected);
                    assert!(error < 1e-40, "{form:?} at {velocities:?}: {error:e}");
                }
            }
        }
    }
}
