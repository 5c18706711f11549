//! Scenes by the clause.

// The robot file has none, and the clause takes a name alone.
dalembert::dynamics! {
    mod no_scene = "robots/planar2r.toml";
    scene: pick;
}

dalembert::dynamics! {
    mod scene_in_the_clause = "robots/planar2r.toml";
    outputs: inverse_dynamics;
    scene: hold { lock: { elbow: pi/2 } };
}

fn main() {}
