//! Every error of the file at once, each with its line.
dalembert::dynamics! {
    mod arm = "robots/mistakes.toml";
    outputs: gravity;
}

fn main() {
    let _: [f64; 2] = arm::gravity(&[0.0, 0.0]);
}
