//! It has its name already.
dalembert::dynamics! {
    mod arm {
        name: planar;
        convention: standard;
        gravity: [0, -9.81, 0];
        joint { kind: revolute, a: 1, mass: 1, com: [-0.5, 0, 0], inertia: [0, 1/12, 1/12, 0, 0, 0] }
    }
    outputs: gravity;
}

fn main() {}
