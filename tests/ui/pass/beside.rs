//! A robot file beside the file with the macro, which the folder of Cargo.toml lacks.

dalembert::dynamics! {
    mod arm = "beside.toml";
    outputs: gravity;
}

fn main() {
    let upright = [core::f64::consts::FRAC_PI_2, 0.0];
    assert!(arm::gravity(&upright).iter().all(|torque| torque.abs() < 1e-12));
}
