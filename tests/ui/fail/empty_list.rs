//! A clause without a word: nothing is taken in its place.
dalembert::dynamics! {
    mod bare = "robots/planar2r.toml";
    outputs: ;
    formulation: ;
}

dalembert::dynamics! {
    mod brackets = "robots/planar2r.toml";
    outputs: [];
    formulation: [];
}

dalembert::dynamics! {
    mod commas = "robots/planar2r.toml";
    outputs: gravity,, inertia;
}

fn main() {}
