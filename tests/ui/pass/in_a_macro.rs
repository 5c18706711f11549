#![deny(warnings)]
//! Names and robots that come through another macro are in invisible groups.

macro_rules! still {
    ($name:ident, $robot:literal) => {
        dalembert::dynamics! {
            mod $name = $robot;
            outputs: inertia, gravity;
        }
    };
}

still!(file, "robots/planar2r.toml");
still!(
    pendulum,
    r#"
    name = "pendulum"
    convention = "standard"
    gravity = [0, -9.81, 0]
    [[joint]]
    kind = "revolute"
    a = 0.5
    mass = 1
    com = [0, 0, 0]
    inertia = [0, 0, 0, 0, 0, 0]
    "#
);

fn main() {
    assert_eq!(pendulum::inertia(&[0.0]), [[0.25]]);
    assert_eq!(pendulum::gravity(&[0.0]), [0.5 * 9.81]);
    assert_eq!(file::gravity(&[0.0, 0.0])[1], 0.5 * 9.81);
}
