#![deny(warnings, missing_docs)]
//! The module says where polynomials for sines hold, and asks; a joint without
//! limits turns without end. A list of outputs may stand in brackets.
dalembert::dynamics! {
    /// A joint with limits and one without.
    pub mod arm = r#"
        name = "arm"
        convention = "standard"
        gravity = [0, -9.81, 0]
        [[joint]]
        kind = "revolute"
        a = 1
        mass = 1
        com = [-0.5, 0, 0]
        inertia = [0, "1/12", "1/12", 0, 0, 0]
        limits = { position = [-2, 2] }
        [[joint]]
        kind = "revolute"
        a = 1
        mass = 1
        com = [-0.5, 0, 0]
        inertia = [0, "1/12", "1/12", 0, 0, 0]
    "#;
    outputs: [gravity, inertia];
    sincos: polynomial;
}

fn main() {
    assert_eq!(arm::BOX.q, [[-2.0, 2.0], [-1e6, 1e6]]);
    assert!(arm::in_box(&[2.0, 0.0]) && !arm::in_box(&[2.0f64.next_up(), 0.0]));
    assert!(arm::in_box(&[0.0, -1e6]) && !arm::in_box(&[0.0, f64::NAN]));
    // A thousand turns are no turn.
    let turns = 2000.0 * std::f64::consts::PI;
    let [here, there] = [0.7, 0.7 + turns].map(|q2| arm::gravity(&[0.3, q2]));
    let exact = 0.5 * 9.81 * 1.0f64.cos();
    for torque in [here[1], there[1]] {
        assert!((torque - exact).abs() < 0.5 * 9.81 * 1e-6, "{torque} {exact}");
    }
}
