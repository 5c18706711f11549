//! A scalar that there is not.
dalembert::dynamics! {
    mod arm = "robots/planar2r.toml";
    outputs: gravity;
    scalar: f46;
}

fn main() {}
