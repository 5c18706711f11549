//! A scene in the macro, of a robot in a file.
dalembert::dynamics! {
    mod arm = "robots/planar2r.toml";
    outputs: inverse_dynamics;
    scalar: f64;
    scene: hold { lock: { elbow: pi/2 }, velocity: zero, gravity: [0, -1.62, 0] };
}

fn main() {
    let tau: [f64; 1] = arm::inverse_dynamics(&[0.0, 0.0], &[0.0, 0.0]);
    // The folded arm on the moon: 1.62·(0.5 + 1.0) N·m.
    assert!((tau[0] - 1.62 * 1.5).abs() < 1e-12);
}
