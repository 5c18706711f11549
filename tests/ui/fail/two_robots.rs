//! One robot an invocation.
dalembert::dynamics! {
    mod arm = "robots/planar2r.toml";
    outputs: gravity;

    /// And another.
    pub mod other = "robots/planar2r.toml";
    outputs: gravity;
}

fn main() {}
