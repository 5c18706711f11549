//! A robot without joints.
dalembert::dynamics! {
    mod arm {
        convention: standard;
        gravity: [0, -9.81, 0];
    }
    outputs: gravity;
}

fn main() {}
