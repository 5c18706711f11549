//! Angles of no form that there is.
dalembert::dynamics! {
    mod arm {
        convention: standard;
        gravity: [0, -9.81, 0];
        joint { kind: revolute, alpha: pi/0, offset: 90rad, mass: 1, com: [-0.5, 0, 0], inertia: [0, 1/12, 1/12, 0, 0, 0] }
        joint { kind: revolute, alpha: pie/2, offset: pi*2, mass: 1, com: [-0.5, 0, 0], inertia: [0, 1/12, 1/12, 0, 0, 0] }
    }
    outputs: gravity;
}

fn main() {}
