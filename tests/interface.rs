//! Code that is generic over robots: a controller and an observer for arms of any
//! number of joints, in either scalar, for generated robots and for one by hand.

use dalembert::interface as ask;
use dalembert::interface::{ForwardDynamics, Gravity, Inertia, InverseDynamics};

dalembert::dynamics! {
    mod planar2r = "generated/robots/planar2r.toml";
    outputs: inverse_dynamics, gravity, inertia, forward_dynamics, kinetic_energy, potential_energy,
        coriolis, coriolis_matrix, forward_kinematics, link_poses, jacobian, jacobian_rate,
        reaction_wrenches, passivity, inertia_inverse, momentum, regressor, hold = gravity + jacobian;
    interface: traits;
    scalar: f64, f32;
}

dalembert::dynamics! {
    mod planar3r = "generated/robots/planar3r.toml";
    outputs: inverse_dynamics, forward_dynamics, gravity, inertia;
    interface: traits;
}

// Of this scene `gravity` has an argument an entry a joint, and a row less: no trait
// has its signature.
dalembert::dynamics! {
    mod locked = "generated/robots/planar3r.toml";
    outputs: gravity, coriolis;
    scene: reach { lock: { 2: 0 } };
    interface: traits;
}

/// Computed torque: all that it knows of the robot is what it can be asked.
fn control<const N: usize>(
    robot: &impl InverseDynamics<f64, N>,
    wanted: &[f64; N],
    q: &[f64; N],
    qd: &[f64; N],
) -> [f64; N] {
    let qdd = std::array::from_fn(|i| 100.0 * (wanted[i] - q[i]) - 20.0 * qd[i]);
    robot.inverse_dynamics(q, qd, &qdd)
}

/// The controlled arm from rest, by steps of a millisecond: how far it is in the end.
fn reach<R, const N: usize>(robot: R, wanted: [f64; N]) -> f64
where
    R: InverseDynamics<f64, N> + ForwardDynamics<f64, N>,
{
    let (mut q, mut qd) = ([0.0; N], [0.0; N]);
    for _ in 0..2000 {
        let tau = control(&robot, &wanted, &q, &qd);
        let qdd = robot.forward_dynamics(&q, &qd, &tau);
        for i in 0..N {
            qd[i] += 1e-3 * qdd[i];
            q[i] += 1e-3 * qd[i];
        }
    }
    let off = q.iter().zip(wanted).map(|(q, wanted)| (q - wanted).abs());
    off.fold(0.0, f64::max)
}

#[test]
fn one_controller_for_two_robots() {
    assert!(reach(planar2r::Robot, [0.4, -0.7]) < 1e-6);
    assert!(reach(planar3r::Robot, [0.4, -0.7, 1.1]) < 1e-6);
    // Another's gains would show: uncontrolled, the arms fall.
    struct Slack;
    impl InverseDynamics<f64, 2> for Slack {
        fn inverse_dynamics(&self, _: &[f64; 2], _: &[f64; 2], _: &[f64; 2]) -> [f64; 2] {
            [0.0; 2]
        }
    }
    impl ForwardDynamics<f64, 2> for Slack {
        fn forward_dynamics(&self, q: &[f64; 2], qd: &[f64; 2], tau: &[f64; 2]) -> [f64; 2] {
            planar2r::forward_dynamics(q, qd, tau)
        }
    }
    assert!(reach(Slack, [0.4, -0.7]) > 0.1);
}

/// Answers are those of the functions, bit for bit, in either scalar; by reference
/// and behind a `dyn`, too.
#[test]
fn answers_are_the_functions() {
    let (q, qd, qdd) = ([0.3, -0.5], [0.7, 0.2], [-0.4, 1.1]);
    let robot = planar2r::Robot;
    assert_eq!(
        robot.inverse_dynamics(&q, &qd, &qdd),
        planar2r::inverse_dynamics(&q, &qd, &qdd)
    );
    let behind: &dyn Gravity<f64, 2> = &robot;
    assert_eq!(behind.gravity(&q), planar2r::gravity(&q));
    assert_eq!((&&robot).inertia(&q), planar2r::inertia(&q));
    let single = planar2r_f32::Robot;
    assert_eq!(
        single.gravity(&[0.3, -0.5]),
        planar2r_f32::gravity(&[0.3, -0.5])
    );
    assert_eq!(
        planar3r::Robot.inertia(&[0.1; 3]),
        planar3r::inertia(&[0.1; 3])
    );
}

/// Every question that one array answers is a trait, and the type has it.
#[test]
fn every_question_has_a_trait() {
    fn all<T, const N: usize>(
        _: impl ask::InverseDynamics<T, N>
        + ask::Gravity<T, N>
        + ask::Inertia<T, N>
        + ask::Coriolis<T, N>
        + ask::KineticEnergy<T, N>
        + ask::PotentialEnergy<T, N>
        + ask::CoriolisMatrix<T, N>
        + ask::ForwardKinematics<T, N>
        + ask::LinkPoses<T, N>
        + ask::Jacobian<T, N>
        + ask::JacobianRate<T, N>
        + ask::ReactionWrenches<T, N>
        + ask::Passivity<T, N>
        + ask::ForwardDynamics<T, N>
        + ask::InertiaInverse<T, N>,
    ) {
    }
    all(planar2r::Robot);
    all(planar2r_f32::Robot);
    // An output that is added has a trait as well, or its module does not compile.
    let source = include_str!("../src/interface.rs");
    for function in dalembert_codegen::Function::ALL {
        let question = dalembert_codegen::emit::interface::question(function);
        let known = source.contains(&format!("    {}::{function}(", function.camel()));
        assert_eq!(question.is_some(), known, "{function}");
    }
}

#[test]
fn what_is_a_modules_own_is_called_by_name() {
    let hold: planar2r::Hold = planar2r::hold(&[0.3, -0.5]);
    assert_eq!(hold.c, planar2r::Robot.gravity(&[0.3, -0.5]));
    let load: [f64; 2] = locked::gravity(&[0.1, 0.0, 0.2]);
    assert!(load[0] > load[1]);
    let _: locked::Robot = Default::default();
}
