//! The first one counts.
dalembert::dynamics! {
    mod arm = "robots/planar2r.toml";
    outputs: gravity;
    scalar: f64;
    outputs: inertia;
}

fn main() {}
