//! A bundle is no part of another one: its own parts are.
dalembert::dynamics! {
    mod arm = "robots/planar2r.toml";
    outputs: hold = inertia + gravity, servo = hold + jacobian;
}

fn main() {}
