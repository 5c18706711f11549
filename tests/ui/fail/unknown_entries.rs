//! A slip in the entries, which is the only error: calls of what was meant are
//! none.
dalembert::dynamics! {
    mod arm = "robots/planar2r.toml";
    outputs: gravity, manipulator_equation;
    entries: lane;
}

dalembert::dynamics! {
    mod other = "robots/planar2r.toml";
    outputs: gravity;
    entries: simd;
}

fn main() {
    let q = [[0.5; 8]; 2];
    let _ = (arm::gravity_lanes(&q), arm::manipulator_equation_lanes(&q, &q).d);
    let _ = arm::gravity_with_sincos(&[0.5; 2], &[0.5; 2], &[0.5; 2]);
}
