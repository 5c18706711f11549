//! Robot files.

// A bad number in the robot file, and callers that do not cascade.
dalembert::dynamics! {
    mod bad_number_in_file = "robots/bad_number.toml";
    outputs: gravity;
}

// The file is TOML, but no robot.
dalembert::dynamics! {
    mod empty_file = "robots/empty.toml";
    outputs: gravity;
}

// Legal TOML of what no robot may be: each value at its line, all at once.
dalembert::dynamics! {
    mod impossible_robot = "robots/impossible.toml";
    outputs: gravity;
}

// No such file: its callers are checked all the same.
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

// The file is no TOML.
dalembert::dynamics! {
    mod not_a_robot_file = "robots/notes.txt";
    outputs: gravity;
}

fn main() {
    let _: [f64; 2] = bad_number_in_file::gravity(&[0.0, 0.0]);
    let _: [f64; 2] = impossible_robot::gravity(&[0.0, 0.0]);
    let _: [f64; 2] = missing_file::gravity(&[0.0, 0.0]);
    let _: [f64; 2] = mistakes_in_file::gravity(&[0.0, 0.0]);
}
