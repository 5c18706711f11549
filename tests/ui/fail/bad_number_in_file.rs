//! A bad number in the robot file, and callers that do not cascade.
dalembert::dynamics! {
    mod arm = "robots/bad_number.toml";
    outputs: gravity;
}

fn main() {
    let _: [f64; 2] = arm::gravity(&[0.0, 0.0]);
}
