//! Arms for the tests of the equations: golden robots and random general ones.
#![allow(dead_code, reason = "each test file uses its own part")]

pub mod extremes;
pub mod golden;
pub mod known;
pub mod random;

use dalembert_model::equations::{Arm, JointPosition, SinCosPair};
use dalembert_model::robot::JointKind;

/// Returns max|a − b| / max|b|; the larger of the two when b is zero.
pub fn normwise(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
    let error = largest(&mut a.iter().zip(b).map(|(a, b)| (a - b).abs()));
    let size = largest(&mut b.iter().map(|b| b.abs()));
    if size == 0.0 { error } else { error / size }
}

/// Positions of an f64 arm from its joint values.
pub fn positions(arm: &Arm<f64>, q: &[f64]) -> Vec<JointPosition<f64>> {
    let of = |(link, q): (&dalembert_model::equations::Link<f64>, &f64)| match link.kind {
        JointKind::Revolute => {
            let (sin, cos) = libm::sincos(*q);
            JointPosition::Revolute(SinCosPair { sin, cos })
        }
        JointKind::Prismatic => JointPosition::Prismatic(*q),
    };
    arm.links.iter().zip(q).map(of).collect()
}
