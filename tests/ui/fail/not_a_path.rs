//! The path has no quotes.
dalembert::dynamics! {
    mod arm = robots/planar2r.toml;
    outputs: gravity;
}

fn main() {}
