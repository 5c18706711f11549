//! Tests the build script's code against the dynamics of the arm.

use with_build_script::{arm, kinetic_energy};

/// Power is the rate of the energy: q̇ᵀ(τ − c) = d/dt ½ q̇ᵀ D q̇.
#[test]
fn work_becomes_energy() {
    let (q, qd, qdd) = ([0.3, -0.8], [1.1, 0.4], [-0.7, 0.9]);
    let tau = arm::inverse_dynamics(&q, &qd, &qdd);
    let c = arm::manipulator_equation(&q, &qd).c;
    let power: f64 = (0..arm::N).map(|i| qd[i] * (tau[i] - c[i])).sum();

    let energy = |t: f64| {
        let q: [f64; arm::N] = core::array::from_fn(|i| q[i] + t * (qd[i] + 0.5 * t * qdd[i]));
        let qd: [f64; arm::N] = core::array::from_fn(|i| qd[i] + t * qdd[i]);
        kinetic_energy(&q, &qd)
    };
    let t = 1e-5;
    let gain = (energy(t) - energy(-t)) / (2.0 * t);
    assert!((power - gain).abs() < 1e-8, "{power} {gain}");
}
