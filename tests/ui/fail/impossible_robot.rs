//! Legal TOML of what no robot may be: each value at its line, all at once.
dalembert::dynamics! {
    mod arm = "robots/impossible.toml";
    outputs: gravity;
}

fn main() {
    let _: [f64; 2] = arm::gravity(&[0.0, 0.0]);
}
