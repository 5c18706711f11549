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

// What is wrong with one item hides nothing of the others.
dalembert::dynamics! {
    mod nothing = "robots/planar2r.toml";
    outputs: gravity, other = gravty + jacobian, alone = inertia;
    parameters: [];
}

fn main() {}
