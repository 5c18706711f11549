//! At the name of the robot that lacks it.
dalembert::dynamics! {
    mod arm {
        convention: standard;
        joint { kind: revolute, a: 1, mass: 1, com: [-0.5, 0, 0], inertia: [0, 1/12, 1/12, 0, 0, 0] }
    }
    outputs: gravity;
}

fn main() {}
