//! Measures what `dynamics!` costs in a crate with cargo's default profile.

dalembert::dynamics! {
    /// Unimation PUMA 560.
    pub mod puma560 = "../../generated/robots/puma560.toml";
    outputs: inverse_dynamics;
    scalar: f64;
}

fn main() {
    let tau = puma560::inverse_dynamics(&[0.1; 6], &[0.2; 6], &[0.3; 6]);
    println!("{tau:?}");
}
