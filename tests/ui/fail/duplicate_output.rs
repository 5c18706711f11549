//! A word twice in a list.
dalembert::dynamics! {
    mod arm = "robots/planar2r.toml";
    outputs: gravity, inertia, gravity;
    scalar: f32, f32;
}

fn main() {}
