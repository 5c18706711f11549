//! A scene in the macro: its mistakes are at its tokens.
dalembert::dynamics! {
    mod arm = "robots/planar2r.toml";
    outputs: inverse_dynamics;
    scalar: f64;
    scene: hold {
        lock: { elbw: pi/2 },
        tolerance: { value: -1e-3, relative_to: range },
        box: { velocity: [1, 2, 3] },
    };
}

fn main() {}
