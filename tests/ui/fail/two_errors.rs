//! Clauses and robot: all of it at once.
dalembert::dynamics! {
    mod arm {
        convention: standard;
        gravity: [0, -9.81, 0];
        joint { kind: revolte, mass: 1, com: [0, 0, 0], inertia: [0, 0, 1, 0, 0, 0] }
        joint { kind: revolute, mass: -1, com: [0, 0, 0], inertia: [0, 0, 0, 0, 0, 0] }
    }
    outputs: gravitation;
    scalar: f16;
}

fn main() {}
