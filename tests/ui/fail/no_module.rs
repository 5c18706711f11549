//! The word `mod` is missing.
dalembert::dynamics! {
    pub arm = "robots/planar2r.toml";
    outputs: gravity;
}

fn main() {}
