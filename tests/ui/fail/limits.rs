//! A block in a joint.
dalembert::dynamics! {
    mod arm {
        convention: standard;
        gravity: [0, -9.81, 0];
        joint { kind: revolute, mass: 1, com: [-0.5, 0, 0], inertia: [0, 1/12, 1/12, 0, 0, 0], limits: { position: [1, -1], speed: 3 } }
    }
    outputs: gravity;
}

fn main() {}
