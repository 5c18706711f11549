//! Polynomials for sines: by the clause, over the joint's limits.
dalembert::dynamics! {
    mod arm = r#"
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
    "#;
    outputs: gravity;
    sincos: polynomial;
    sincos_error: 1e-3;
}

fn main() {
    let [torque] = arm::gravity(&[0.5]);
    let exact = 9.81 * 0.5 * 0.5f64.cos();
    let error = (torque - exact).abs();
    assert!(error > 1e-12 && error < 9.81 * 0.5 * 1e-3, "{error:e}");
}
