//! Parts that a bundle cannot have: an unknown one, none, one twice; one alone.
dalembert::dynamics! {
    mod arm = "robots/planar2r.toml";
    outputs:
        still = inertia + gravty,
        open = inertia +,
        twice = gravity + inertia + gravity;
}

dalembert::dynamics! {
    mod other = "robots/planar2r.toml";
    outputs: alone = gravity;
}

fn main() {
    let _ = arm::still(&[0.0, 0.0]);
}
