#![deny(warnings)]
//! A robot in the macro: the text of a robot file.
dalembert::dynamics! {
    pub(crate) mod arm = r#"
        name = "arm"
        convention = "modified"
        gravity = [0, 0, -9_810e-3]
        [[joint]]
        name = "slide 1"
        kind = "prismatic"
        theta = "-90deg"
        offset = 0.25
        mass = 2.5
        com = [0, 0.1, 0]
        inertia = [[0.1, 0, 0], [0, 0.1, 0], [0, 0, 0.05]]
        limits = { position = [-0.5, "1/2"], velocity = 2 }
        [[joint]]
        name = "swing"
        kind = "revolute"
        alpha = "-pi/2"
        a = 0.3
        offset = "3*pi/4"
        viscous = 0.1
        armature = 1e-3
        mass = 0
        inertia = [0, 0, 0, 0, 0, 0]
    "#;
    outputs: inertia, coriolis,;
}

fn main() {
    let d: [[f64; 2]; 2] = arm::inertia(&[0.0, 0.0]);
    assert_eq!(d, [[2.5, 0.0], [0.0, 1e-3]]);
    assert_eq!(arm::coriolis(&[0.0, 0.0], &[1.0, 1.0]), [0.0, 0.0]);
}
