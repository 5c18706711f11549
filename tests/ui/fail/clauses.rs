//! Clauses: what stands around words.

// The first one counts.
dalembert::dynamics! {
    mod duplicate_clause = "robots/planar2r.toml";
    outputs: gravity;
    scalar: f64;
    outputs: inertia;
}

// A clause without a word: nothing is taken in its place.
dalembert::dynamics! {
    mod empty_list_bare = "robots/planar2r.toml";
    outputs: ;
    formulation: ;
}

dalembert::dynamics! {
    mod empty_list_brackets = "robots/planar2r.toml";
    outputs: [];
    formulation: [];
}

dalembert::dynamics! {
    mod empty_list_commas = "robots/planar2r.toml";
    outputs: gravity,, inertia;
}

// What is wrong with one item hides nothing of the others.
dalembert::dynamics! {
    mod empty_list_nothing = "robots/planar2r.toml";
    outputs: gravity, other = gravty + jacobian, alone = inertia;
    parameters: [];
}

// Clauses have colons.
dalembert::dynamics! {
    mod equals_for_colon = "robots/planar2r.toml";
    outputs = gravity;
    scalar f64;
}

// There is no default: every function costs compile time.
dalembert::dynamics! {
    mod missing_outputs = "robots/planar2r.toml";
    scalar: f64;
}

// The next clause begins.
dalembert::dynamics! {
    mod missing_semicolon = "robots/planar2r.toml";
    outputs: gravity
    scalar: f64;
}

// Two words with nothing between.
dalembert::dynamics! {
    mod missing_comma = "robots/planar2r.toml";
    outputs: inverse_dynamics gravity;
}

// One clause is a slip, the other nothing known.
dalembert::dynamics! {
    mod unknown_clause = "robots/planar2r.toml";
    output: gravity;
    formulas: auto;
}

// One robot an invocation.
dalembert::dynamics! {
    mod two_robots = "robots/planar2r.toml";
    outputs: gravity;

    /// And another.
    pub mod other = "robots/planar2r.toml";
    outputs: gravity;
}

// It would be taken from inside the module.
dalembert::dynamics! {
    mod relative_crate_path = "robots/planar2r.toml";
    outputs: gravity;
    crate = super::dalembert;
}

fn main() {}
