//! The file is TOML, but no robot.
dalembert::dynamics! {
    mod arm = "robots/empty.toml";
    outputs: gravity;
}

fn main() {}
