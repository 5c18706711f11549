//! Clauses have colons.
dalembert::dynamics! {
    mod arm = "robots/planar2r.toml";
    outputs = gravity;
    scalar f64;
}

fn main() {
    let _: [f64; 2] = arm::gravity(&[0.0, 0.0]);
}
