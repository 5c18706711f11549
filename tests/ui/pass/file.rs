#![deny(warnings, missing_docs)]
//! Everything in a file, every clause, and no warning of any lint.
dalembert::dynamics! {
    /// An arm from a file.
    pub mod arm = "robots/planar2r.toml";
    outputs: inverse_dynamics, gravity, manipulator_equation,;
    scalar: f64;
    formulation: auto;
    effort: quick;
}

fn main() {
    let tau: [f64; arm::N] = arm::inverse_dynamics(&[0.1, 0.2], &[0.3, 0.4], &[0.5, 0.6]);
    let arm::ManipulatorEquation { d, h, c } = arm::manipulator_equation(&[0.1, 0.2], &[0.3, 0.4]);
    for i in 0..arm::N {
        let sum = d[i][0] * 0.5 + d[i][1] * 0.6 + h[i] + c[i];
        assert!((tau[i] - sum).abs() < 1e-12);
    }
}
