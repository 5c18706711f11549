//! What no robot may be is said at its token.
dalembert::dynamics! {
    mod arm {
        convention: standard;
        gravity: [0, -9.81, 0];
        joint { kind: revolute, mass: -17.4, com: [0, 0, 0], inertia: [0, 0, 0, 0, 0, 0] }
    }
    outputs: gravity;
}

fn main() {}
