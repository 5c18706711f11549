//! It would be taken from inside the module.
dalembert::dynamics! {
    mod arm = "robots/planar2r.toml";
    outputs: gravity;
    crate = super::dalembert;
}

fn main() {}
