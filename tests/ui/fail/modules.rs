//! What the module is called, and where its robot comes from.

// A word of the language names no module.
dalembert::dynamics! {
    pub mod type = "robots/planar2r.toml";
    outputs: gravity;
}

// A robot in the macro is called after its module.
dalembert::dynamics! {
    mod PlanarArm {
        convention: standard;
        gravity: [0, -9.81, 0];
        joint { kind: revolute, a: 1, mass: 1, com: [-0.5, 0, 0], inertia: [0, 1/12, 1/12, 0, 0, 0] }
    }
    outputs: gravity;
}

// It has its name already.
dalembert::dynamics! {
    mod named_robot {
        name: planar;
        convention: standard;
        gravity: [0, -9.81, 0];
        joint { kind: revolute, a: 1, mass: 1, com: [-0.5, 0, 0], inertia: [0, 1/12, 1/12, 0, 0, 0] }
    }
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
