//! The macro, which takes the checked-in code beside each robot file: how much torque
//! each arm needs to hold still, and to start moving.

dalembert::dynamics! {
    /// Unimation PUMA 560.
    pub mod puma560 = "../../generated/robots/puma560.toml";
    outputs: inverse_dynamics, gravity;
    scalar: f64;
}

dalembert::dynamics! {
    /// A carriage with a pendulum.
    mod crane = "robots/crane.toml";
    outputs: inverse_dynamics, gravity;
    scalar: f64, f32;
}

fn main() {
    let q = [0.1, -0.5, 0.3, 0.0, 0.7, 0.2];
    let hold = puma560::gravity(&q);
    let start = puma560::inverse_dynamics(&q, &[0.0; 6], &[1.0; 6]);
    println!("puma560 hold  {hold:8.3?}");
    println!("puma560 start {start:8.3?}");

    let swing = [0.0, 0.2];
    println!("crane hold    {:8.3?}", crane::gravity(&swing));
    println!("crane in f32  {:8.3?}", crane_f32::gravity(&[0.0, 0.2]));
    let start = crane::inverse_dynamics(&swing, &[0.5, 0.0], &[1.0, 0.0]);
    println!("crane start   {start:8.3?}");
}
