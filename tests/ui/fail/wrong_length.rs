//! Arrays too short.
dalembert::dynamics! {
    mod arm {
        convention: standard;
        gravity: [-9.81];
        joint { kind: revolute, mass: 1, com: [-0.5, 0], inertia: [0, 1, 1] }
    }
    outputs: gravity;
}

fn main() {}
