//! One clause is a slip, the other nothing known.
dalembert::dynamics! {
    mod arm = "robots/planar2r.toml";
    output: gravity;
    formulas: auto;
}

fn main() {}
