#![deny(warnings)]
//! Two modules.
dalembert::dynamics! {
    mod arm = "robots/planar2r.toml";
    outputs: gravity;
    scalar: f32, f64;
}

fn main() {
    let double: [f64; 2] = arm::gravity(&[0.5, 0.5]);
    let single: [f32; 2] = arm_f32::gravity(&[0.5, 0.5]);
    assert!((double[0] - f64::from(single[0])).abs() < 1e-5);
}
