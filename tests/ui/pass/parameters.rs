//! A payload and gravity as arguments, by the clause.
dalembert::dynamics! {
    mod arm = "robots/planar2r.toml";
    outputs: gravity, inertia, forward_kinematics;
    parameters: payload, gravity;
}

fn main() {
    let nothing = arm::Payload::NONE;
    let load: arm::Load = arm::load(&nothing);
    let q = [0.5, -0.3];
    let down = arm::gravity(&q, &arm::Gravity([0.0, -9.81, 0.0]), &load);
    // The links are equal, and as heavy as they are long: by hand.
    let second = 0.5 * 9.81 * (q[0] + q[1]).cos();
    let first = 1.5 * 9.81 * q[0].cos() + second;
    assert!((down[0] - first).abs() < 1e-12 && (down[1] - second).abs() < 1e-12);
    // A kilogram at the hand has its lever too.
    let kilogram = arm::Payload::new(1.0, [0.0; 3], [0.0; 6]);
    assert_eq!(kilogram[0], 1.0);
    let heavy = arm::load(&kilogram);
    let more = arm::gravity(&q, &arm::Gravity([0.0, -9.81, 0.0]), &heavy);
    assert!((more[1] - down[1] - 9.81 * (q[0] + q[1]).cos()).abs() < 1e-12);
    // D takes no gravity, poses take nothing.
    assert!(arm::inertia(&q, &heavy)[1][1] > arm::inertia(&q, &load)[1][1]);
    let _ = arm::forward_kinematics(&q);
}
