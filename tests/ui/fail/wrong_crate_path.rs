//! One error, not one a call of sine.
dalembert::dynamics! {
    mod arm = "robots/planar2r.toml";
    outputs: inverse_dynamics, gravity;
    crate = ::dalember;
}

fn main() {}
