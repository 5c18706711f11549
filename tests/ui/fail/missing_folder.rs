//! No such file and nothing like it.
dalembert::dynamics! {
    mod arm = "arms/nothing.toml";
    outputs: gravity;
}

fn main() {}
