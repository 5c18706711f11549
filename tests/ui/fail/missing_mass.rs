//! At the joint that lacks it; two joints for its callers.
dalembert::dynamics! {
    mod arm {
        convention: standard;
        gravity: [0, -9.81, 0];
        joint { kind: revolute, a: 1, mass: 1, com: [-0.5, 0, 0], inertia: [0, 1/12, 1/12, 0, 0, 0] }
        joint { kind: revolute, com: [0, 0, 0], inertia: [0, 0, 1, 0, 0, 0] }
    }
    outputs: gravity;
}

fn main() {
    let _: [f64; 2] = arm::gravity(&[0.0, 0.0]);
}
