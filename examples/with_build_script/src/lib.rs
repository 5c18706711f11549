//! Dynamics from the build script, `no_std` and with no dependency but libm.
#![no_std]

include!(concat!(env!("OUT_DIR"), "/arm.rs"));

/// Returns the kinetic energy ½ q̇ᵀ D q̇.
pub fn kinetic_energy(q: &[f64; arm::N], qd: &[f64; arm::N]) -> f64 {
    let d = arm::manipulator_equation(q, qd).d;
    let momentum = d.map(|row| row[0] * qd[0] + row[1] * qd[1]);
    0.5 * (momentum[0] * qd[0] + momentum[1] * qd[1])
}
