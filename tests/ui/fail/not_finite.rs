//! Numbers that are none, infinite, hexadecimal, too large.
dalembert::dynamics! {
    mod arm {
        convention: standard;
        gravity: [0, -9.81, 0];
        joint { kind: revolute, mass: NaN, com: [-inf, 0, 0], inertia: [0, 0, 0x10, 0, 1e999, 0] }
    }
    outputs: gravity;
}

fn main() {}
