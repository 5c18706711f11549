//! The name of the module, and the source of its robot.

// A word of the language names no module.
dalembert::dynamics! {
    pub mod type = "robots/planar2r.toml";
    outputs: gravity;
}

// The text of a robot file has errors of its own, each with its line.
dalembert::dynamics! {
    mod text = r#"
        name = "PlanarArm"
        convention = "standard"
        gravity = [0, nan, 0]
        [[joint]]
        kind = "revolute"
        mass = 0
    "#;
    outputs: gravity;
}

// A robot is no block.
dalembert::dynamics! {
    mod block { convention: standard; }
    outputs: gravity;
}

// The word `mod` is missing.
dalembert::dynamics! {
    pub arm = "robots/planar2r.toml";
    outputs: gravity;
}

// The path has no quotes.
dalembert::dynamics! {
    mod not_a_path = robots/planar2r.toml;
    outputs: gravity;
}

fn main() {}
