//! The file is no TOML.
dalembert::dynamics! {
    mod arm = "robots/notes.txt";
    outputs: gravity;
}

fn main() {}
