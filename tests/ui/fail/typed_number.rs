//! Numbers as Rust has them, but not robots.
dalembert::dynamics! {
    mod arm {
        convention: standard;
        gravity: [0, -9.81, 0];
        joint { kind: revolute, mass: 1.5f64, com: [1., 0, .5], inertia: [0, 0, 0, 0, 0, 0] }
    }
    outputs: gravity;
}

fn main() {}
