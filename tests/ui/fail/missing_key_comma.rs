//! Commas and colons of a joint.
dalembert::dynamics! {
    mod arm {
        convention: standard;
        gravity: [0, -9.81, 0];
        joint { kind: revolute a: 1, mass = 1, com: [0, 0, 0]; inertia: [0, 0, 1, 0, 0, 0] }
    }
    outputs: gravity;
}

fn main() {}
