//! Code that is generic over robots: a controller and an observer for arms of any
//! number of joints, in either scalar, for generated robots and for one by hand.

use dalembert::interface as ask;
use dalembert::interface::{
    ForwardDynamics, Gravity, Inertia, InverseDynamics, ManipulatorEquation, Regressor, answers,
};

dalembert::dynamics! {
    mod planar2r = "generated/robots/planar2r.toml";
    outputs: inverse_dynamics, gravity, inertia, forward_dynamics, kinetic_energy, potential_energy,
        coriolis, coriolis_matrix, forward_kinematics, link_poses, jacobian, jacobian_rate,
        reaction_wrenches, passivity, inertia_inverse, momentum, regressor, hold = gravity + jacobian,
        manipulator_equation, dynamic_coefficients, dalembert_terms, inverse_dynamics_derivatives,
        forward_dynamics_derivatives, full_regressor, passivity_regressor;
    interface: traits;
    scalar: f64, f32;
}

dalembert::dynamics! {
    mod planar3r = "generated/robots/planar3r.toml";
    outputs: inverse_dynamics, forward_dynamics, gravity, inertia, manipulator_equation, regressor;
    interface: traits;
}

// Of this scene `gravity` has an argument an entry a joint, and a row less: no trait
// has its signature.
dalembert::dynamics! {
    mod locked = r#"
        name = "planar3r"
        convention = "standard"
        gravity = [0, -9.81, 0]
        outputs = ["inverse_dynamics", "gravity", "inertia", "coriolis", "manipulator_equation", "dynamic_coefficients"]
        [[joint]]
        name = "shoulder"
        kind = "revolute"
        a = 1
        mass = 1
        com = [-0.5, 0, 0]
        inertia = [0, 0.08333333333333333, 0.08333333333333333, 0, 0, 0]
        limits = { position = ["-pi", "pi"] }
        [[joint]]
        name = "elbow"
        kind = "revolute"
        a = 1
        mass = 1
        com = [-0.5, 0, 0]
        inertia = [0, 0.08333333333333333, 0.08333333333333333, 0, 0, 0]
        limits = { position = ["-pi", "pi"] }
        [[joint]]
        name = "wrist"
        kind = "revolute"
        a = 1
        mass = 1
        com = [-0.5, 0, 0]
        inertia = [0, 0.08333333333333333, 0.08333333333333333, 0, 0, 0]
        limits = { position = ["-pi", "pi"] }
        [scene.reach]
        lock = { 2 = 0 }
    "#;
    outputs: gravity, coriolis;
    scene: reach;
    interface: traits;
}

/// Computes the torques of a controller: all that it knows of the robot is what it can be asked.
fn control<const N: usize>(
    robot: &impl InverseDynamics<f64, N>,
    wanted: &[f64; N],
    q: &[f64; N],
    qd: &[f64; N],
) -> [f64; N] {
    let qdd = std::array::from_fn(|i| 100.0 * (wanted[i] - q[i]) - 20.0 * qd[i]);
    robot.inverse_dynamics(q, qd, &qdd)
}

/// Returns the controlled arm from rest, by steps of a millisecond: how far it is in the end.
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

/// Computes them by a struct: D times the acceleration that brings the arm there, with what it
/// takes to keep its motion.
fn control_by_terms<const N: usize>(
    robot: &impl ManipulatorEquation<f64, N>,
    wanted: &[f64; N],
    q: &[f64; N],
    qd: &[f64; N],
) -> [f64; N] {
    let answers::ManipulatorEquation { d, h, c } = robot.manipulator_equation(q, qd);
    let qdd: [f64; N] = std::array::from_fn(|i| 100.0 * (wanted[i] - q[i]) - 20.0 * qd[i]);
    let inertial = |row: &[f64; N]| row.iter().zip(&qdd).map(|(d, qdd)| d * qdd).sum::<f64>();
    std::array::from_fn(|i| inertial(&d[i]) + h[i] + c[i])
}

/// Asserts that both controllers say the same, and a regressor gives what they say from
/// parameters.
fn agree<R, const N: usize, const K: usize>(robot: &R, parameters: &[f64; K])
where
    R: InverseDynamics<f64, N> + ManipulatorEquation<f64, N> + Regressor<f64, N, K>,
{
    let (q, qd) = ([0.3; N], [0.7; N]);
    let tau = control(robot, &[0.5; N], &q, &qd);
    let by_terms = control_by_terms(robot, &[0.5; N], &q, &qd);
    let qdd = [100.0 * 0.2 - 20.0 * 0.7; N];
    let y = robot.regressor(&q, &qd, &qdd);
    for i in 0..N {
        let by_parameters: f64 = y[i].iter().zip(parameters).map(|(y, p)| y * p).sum();
        assert!((tau[i] - by_terms[i]).abs() < 1e-12 * tau[0].abs());
        assert!((tau[i] - by_parameters).abs() < 1e-12 * tau[0].abs());
    }
}

#[test]
fn structs_and_regressors_are_answers_too() {
    agree(&planar2r::Robot, &planar2r::BASE_PARAMETERS);
    agree(&planar3r::Robot, &planar3r::BASE_PARAMETERS);
    // A double of the user's own answers as well, and its answer can be held.
    struct Block;
    impl ManipulatorEquation<f64, 1> for Block {
        fn manipulator_equation(
            &self,
            _: &[f64; 1],
            _: &[f64; 1],
        ) -> answers::ManipulatorEquation<f64, 1> {
            answers::ManipulatorEquation {
                d: [[2.0]],
                h: [0.5],
                c: [3.0],
            }
        }
    }
    assert_eq!(control_by_terms(&Block, &[1.0], &[1.0], &[0.0]), [3.5]);
}

/// Every field is the function's, bit for bit: none trades its place with another of
/// its type.
#[test]
fn answers_have_the_fields_of_the_functions() {
    let (q, qd, third) = ([0.3, -0.5], [0.7, 0.2], [-0.4, 1.1]);
    let robot = planar2r::Robot;
    macro_rules! same {
        ($question:ident, $ask:ident($($argument:expr),*), $($field:ident),*) => {
            let own = planar2r::$ask($($argument),*);
            let answers::$question { $($field),* } = ask::$question::$ask(&robot, $($argument),*);
            $(assert_eq!($field, own.$field, stringify!($field));)*
        };
    }
    same!(ManipulatorEquation, manipulator_equation(&q, &qd), d, h, c);
    same!(DynamicCoefficients, dynamic_coefficients(&q), d, h, c);
    same!(Momentum, momentum(&q, &qd), p, ct_qd);
    same!(
        DalembertTerms,
        dalembert_terms(&q, &qd),
        d_rot,
        d_tran,
        h_rot,
        h_tran,
        c
    );
    same!(
        InverseDynamicsDerivatives,
        inverse_dynamics_derivatives(&q, &qd, &third),
        dtau_dq,
        dtau_dqd,
        d
    );
    same!(
        ForwardDynamicsDerivatives,
        forward_dynamics_derivatives(&q, &qd, &third),
        dqdd_dq,
        dqdd_dqd,
        dqdd_dtau
    );
    let full: [[f64; 20]; 2] = ask::FullRegressor::full_regressor(&robot, &q, &qd, &third);
    assert_eq!(full, planar2r::full_regressor(&q, &qd, &third));
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

/// Every question is a trait, and the type has it.
#[test]
fn every_question_has_a_trait() {
    fn all<T, const N: usize, const K: usize, const L: usize>(
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
        + ask::InertiaInverse<T, N>
        + ask::ManipulatorEquation<T, N>
        + ask::DynamicCoefficients<T, N>
        + ask::Momentum<T, N>
        + ask::DalembertTerms<T, N>
        + ask::InverseDynamicsDerivatives<T, N>
        + ask::ForwardDynamicsDerivatives<T, N>
        + ask::Regressor<T, N, K>
        + ask::PassivityRegressor<T, N, K>
        + ask::FullRegressor<T, N, L>,
    ) {
    }
    all::<f64, 2, _, 20>(planar2r::Robot);
    all::<f32, 2, _, 20>(planar2r_f32::Robot);
    // An output that is added has a trait as well, or its module does not compile.
    let source = include_str!("../src/interface/mod.rs");
    for function in dalembert_codegen::Function::ALL {
        let question = dalembert_codegen::workspace::emit::interface::question(function);
        let names = ["", "<K>"].map(|k| format!("    {}{k}::{function}(", function.camel()));
        let known = names.iter().any(|name| source.contains(name.as_str()));
        assert!(question.is_some() && known, "{function}");
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
