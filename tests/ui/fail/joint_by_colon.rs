//! Joints are blocks called `joint`.
dalembert::dynamics! {
    mod arm {
        convention: standard;
        gravity: [0, 0, -9.81];
        joint: { kind: revolute, a: 1, mass: 1, com: [-0.5, 0, 0], inertia: [0, 1/12, 1/12, 0, 0, 0] };
        link { kind: revolute, a: 1, mass: 1, com: [-0.5, 0, 0], inertia: [0, 1/12, 1/12, 0, 0, 0] }
    }
    outputs: gravity;
}

fn main() {}
