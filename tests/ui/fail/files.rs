//! Robot files.

// A bad number in the robot file.
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

// The file is no TOML.
dalembert::dynamics! {
    mod not_a_robot_file = "robots/notes.txt";
    outputs: gravity;
}

fn main() {}
