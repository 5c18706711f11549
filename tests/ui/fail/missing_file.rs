//! No such file: its callers are checked all the same.
dalembert::dynamics! {
    mod arm = "robots/planar2.toml";
    outputs: gravity;
}

fn main() {
    let _: [f64; 2] = arm::gravity(&[0.0, 0.0]);
}
