//! A word that is no choice.
dalembert::dynamics! {
    mod arm = "robots/planar2r.toml";
    outputs: gravity;
    fma: yes;
}

fn main() {
    let _ = arm::gravity(&[0.5; 2]);
}
