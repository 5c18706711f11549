//! Outputs that several become.

// A bundle is no part of another one: its own parts are.
dalembert::dynamics! {
    mod bundle_in_bundle = "robots/planar2r.toml";
    outputs: hold = inertia + gravity, servo = hold + jacobian;
}

// Names that a bundle cannot have: an output's, a module's own, a word of Rust,
// an ending of the other way to call a function, another bundle's.
dalembert::dynamics! {
    mod bundle_name = "robots/planar2r.toml";
    outputs:
        gravity = inertia + coriolis,
        payload = inertia + gravity,
        loop = inertia + gravity,
        hold_columns = inertia + gravity,
        Hold = inertia + gravity,
        hold = inertia + gravity,
        hold = coriolis + gravity;
}

// Parts that a bundle cannot have: an unknown one, none, one twice; one alone.
dalembert::dynamics! {
    mod bundle_part = "robots/planar2r.toml";
    outputs:
        still = inertia + gravty,
        open = inertia +,
        twice = gravity + inertia + gravity;
}

dalembert::dynamics! {
    mod bundle_part_other = "robots/planar2r.toml";
    outputs: alone = gravity;
}

fn main() {}
