//! Robot files.

// No such file.
dalembert::dynamics! {
    mod missing_file = "robots/planar2.toml";
    outputs: gravity;
}

// No such file and nothing like it.
dalembert::dynamics! {
    mod missing_folder = "arms/nothing.toml";
    outputs: gravity;
}

// Every error of the file at once, each with its line.
dalembert::dynamics! {
    mod mistakes_in_file = "robots/mistakes.toml";
    outputs: gravity;
}

fn main() {}
