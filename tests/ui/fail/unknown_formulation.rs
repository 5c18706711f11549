//! Clauses that take one word of a few.
dalembert::dynamics! {
    mod arm = "robots/planar2r.toml";
    outputs: gravity;
    formulation: newton;
    effort: quick, thorough;
}

fn main() {}
