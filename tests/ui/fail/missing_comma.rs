//! Two words with nothing between.
dalembert::dynamics! {
    mod arm = "robots/planar2r.toml";
    outputs: inverse_dynamics gravity;
}

fn main() {}
