//! Upper bounds on operation counts. They go down: where one rose, the sum over all arms fell.

use dalembert_codegen::{Function, Start};
use dalembert_model::equations::Formulation;

use crate::support;

fn operations(name: &str, function: Function, start: Start) -> usize {
    let generated = support::from(&support::robot(name), function, start);
    generated.functions[0].counts().operations()
}

/// What a quick search gives, without any plan.
#[test]
fn inverse_dynamics() {
    for (name, most) in [
        ("planar2r", 23),
        ("planar3r", 46),
        ("stanford", 212),
        ("puma560", 263),
        ("ur10", 264),
    ] {
        let found = operations(name, Function::InverseDynamics, Start::Auto);
        assert!(found <= most, "{name}: {found}");
    }
}

/// Divisions count as one.
#[test]
fn forward_dynamics_and_derivatives() {
    for (name, forward, derivatives) in [
        ("planar2r", 27, 25),
        ("planar3r", 71, 75),
        ("stanford", 360, 879),
        ("puma560", 400, 1070),
        ("panda", 912, 2495),
    ] {
        for (function, most) in [
            (Function::ForwardDynamics, forward),
            (Function::InverseDynamicsDerivatives, derivatives),
        ] {
            let found = operations(name, function, Start::Auto);
            assert!(found <= most, "{name} {function}: {found}");
        }
    }
}

/// From forms that turn two axes of the hand as well as from those that turn three.
#[test]
fn forward_kinematics() {
    for (name, most) in [
        ("stanford", 52),
        ("puma560", 72),
        ("ur10", 68),
        ("panda", 104),
    ] {
        let found = operations(name, Function::ForwardKinematics, Start::Auto);
        assert!(found <= most, "{name}: {found}");
    }
}

/// From composite momenta, and from the symbols where these are about as cheap.
#[test]
fn coriolis_matrix() {
    for (name, most) in [("stanford", 295), ("puma560", 344), ("ur10", 267)] {
        let found = operations(name, Function::CoriolisMatrix, Start::Auto);
        assert!(found <= most, "{name}: {found}");
    }
}

#[test]
fn lagrange_euler_alone() {
    let lagrange = Start::Only(Formulation::LagrangeEuler);
    assert!(operations("puma560", Function::InverseDynamics, lagrange) < 2700);
    assert!(operations("puma560", Function::DynamicCoefficients, lagrange) < 2200);
}

/// The search starts from the cheapest formulation and never makes it dearer.
#[test]
fn auto_is_never_dearer_than_one_formulation() {
    for name in ["planar2r", "stanford"] {
        for function in Function::ALL[..6].to_vec() {
            let auto = operations(name, function, Start::Auto);
            for formulation in [
                Formulation::LagrangeEuler,
                Formulation::Dalembert,
                Formulation::NewtonEulerLink,
            ] {
                let one = support::from(&support::robot(name), function, Start::Only(formulation));
                // Sines and cosines weigh more than operations: a few more of
                // these may stand for fewer of those.
                let passes = &one.functions[0].passes;
                let folded = passes[1].counts.operations();
                assert!(auto <= folded, "{name} {function} {formulation:?}");
            }
        }
    }
}

/// Arms of other kinds than the checked-in ones.
#[test]
fn other_kinds_of_arms() {
    for (name, most) in [
        ("scara", 62),
        ("gantry", 258),
        ("rprpr", 315),
        ("general6r", 688),
        ("gen3", 537),
    ] {
        let robot = support::read_robot(&support::arm_file(name));
        let generated = support::from(&robot, Function::InverseDynamics, Start::Auto);
        let found = generated.functions[0].counts().operations();
        assert!(found <= most, "{name}: {found}");
    }
}
