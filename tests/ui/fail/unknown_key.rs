//! Keys that a robot or a joint does not have.
dalembert::dynamics! {
    mod arm {
        convention: standard;
        colour: red;
        gravity: [0, -9.81, 0];
        joint { kind: revolute, lenght: 1, mas: 1, com: [0, 0, 0], inertia: [0, 0, 1, 0, 0, 0] }
    }
    outputs: gravity;
}

fn main() {}
