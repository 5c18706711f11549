//! Outputs that several become.

// A bundle is no part of another one; names that a bundle cannot have: a module's own, a word of Rust,
// an ending of the other way to call a function; parts: an unknown one, none, one twice.
dalembert::dynamics! {
    mod bundles = "robots/planar2r.toml";
    outputs:
        hold = inertia + gravity,
        servo = hold + jacobian,
        payload = inertia + gravity,
        loop = inertia + gravity,
        hold_columns = inertia + gravity,
        still = inertia + gravty,
        open = inertia +,
        twice = gravity + inertia + gravity;
}

fn main() {}
