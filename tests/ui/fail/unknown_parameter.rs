//! Slips in the parameters, which are the only errors: calls of what was meant are
//! none.
dalembert::dynamics! {
    mod arm = "robots/planar2r.toml";
    outputs: gravity;
    parameters: paylod, gravity;
}

dalembert::dynamics! {
    mod other = "robots/planar2r.toml";
    outputs: gravity, reaction_wrenches;
    parameters: payload;
}

fn main() {
    let load = arm::load(&[0.0; 10]);
    let _ = arm::gravity(&[0.5; 2], &[0.0; 3], &load);
    let _ = other::reaction_wrenches(&[0.5; 2], &[0.5; 2], &[0.5; 2]);
}
