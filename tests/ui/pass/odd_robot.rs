#![deny(warnings)]
//! Warnings are silenced above the module.
dalembert::dynamics! {
    /// A flywheel that no body is, on a crane.
    #[allow(deprecated)]
    mod crane = r#"
        name = "crane"
        convention = "standard"
        gravity = [0, -9.81, 0]
        [[joint]]
        kind = "revolute"
        a = 20
        mass = 1500
        com = [-10, 0, 0]
        inertia = [1, 1, 3, 0, 0, 0]
    "#;
    outputs: gravity;
}

fn main() {
    assert_eq!(crane::gravity(&[0.0]), [10.0 * 1500.0 * 9.81]);
}
