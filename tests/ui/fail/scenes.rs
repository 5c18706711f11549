//! Scenes in the macro.

// A scene in the macro: its mistakes are at its tokens.
dalembert::dynamics! {
    mod scene_beside_file = "robots/planar2r.toml";
    outputs: inverse_dynamics;
    scalar: f64;
    scene: hold {
        lock: { elbw: pi/2 },
        tolerance: { value: -1e-3, relative_to: range },
        box: { velocity: [1, 2, 3] },
    };
}

// A bound needs a box, and T needs limits: the file has neither.
dalembert::dynamics! {
    mod scene_without_box = "robots/planar2r.toml";
    outputs: inverse_dynamics;
    scalar: f64;
    scene: hold { outputs: [inverse_dynamics], tolerance: { value: 1e-3, relative_to: actuator } };
}

fn main() {}
