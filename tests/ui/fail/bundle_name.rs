//! Names that a bundle cannot have: an output's, a module's own, a word of Rust,
//! an ending of the other ways to call a function, another bundle's.
dalembert::dynamics! {
    mod arm = "robots/planar2r.toml";
    outputs:
        gravity = inertia + coriolis,
        payload = inertia + gravity,
        loop = inertia + gravity,
        hold_lanes = inertia + gravity,
        Hold = inertia + gravity,
        hold = inertia + gravity,
        hold = coriolis + gravity;
}

fn main() {}
