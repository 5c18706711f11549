//! There is no default: every function costs compile time.
dalembert::dynamics! {
    mod arm = "robots/planar2r.toml";
    scalar: f64;
}

fn main() {
    let _: [f64; 2] = arm::gravity(&[0.0, 0.0]);
}
