//! A word of the language names no module.
dalembert::dynamics! {
    pub mod type = "robots/planar2r.toml";
    outputs: gravity;
}

fn main() {}
