#![deny(warnings)]
//! Values that come through another macro are in invisible groups.

macro_rules! pendulum {
    ($name:ident, $length:literal, $gravity:expr) => {
        dalembert::dynamics! {
            mod $name {
                convention: standard;
                gravity: [0, $gravity, 0];
                joint { kind: revolute, a: $length, mass: 1, com: [0, 0, 0], inertia: [0, 0, 0, 0, 0, 0] }
            }
            outputs: inertia, gravity;
        }
    };
}

pendulum!(short, 0.5, -9.81);
pendulum!(long, 2, -10);

fn main() {
    assert_eq!(short::inertia(&[0.0]), [[0.25]]);
    assert_eq!(long::gravity(&[0.0]), [20.0]);
    assert_eq!(short::gravity(&[0.0]), [0.5 * 9.81]);
    assert_eq!(long::inertia(&[0.0]), [[4.0]]);
}
