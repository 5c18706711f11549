//! The word that was meant is suggested, and its callers are not told that it is missing.
dalembert::dynamics! {
    mod arm = "robots/planar2r.toml";
    outputs: inverse_dynamics, gravty;
}

fn main() {
    let _: [f64; 2] = arm::gravity(&[0.0, 0.0]);
}
