//! A bound needs a box, and T needs limits: the file has neither.
dalembert::dynamics! {
    mod arm = "robots/planar2r.toml";
    outputs: inverse_dynamics;
    scalar: f64;
    scene: hold { outputs: [inverse_dynamics], tolerance: { value: 1e-3, relative_to: actuator } };
}

fn main() {}
