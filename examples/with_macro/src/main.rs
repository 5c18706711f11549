//! Uses the macro, which takes the checked-in code beside each robot file. Prints the
//! torques that each arm needs to hold still and to start moving.

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

#[test]
fn the_torques_are_right() {
    // The carriage needs no force to stay; the load needs m g a sin 0.2.
    let lift = 50.0 * 9.81 * 2.0 * 0.2f64.sin();
    let [carriage, load] = crane::gravity(&[0.0, 0.2]);
    assert!(carriage.abs() < 1e-9 && (load.abs() - lift).abs() < 1e-9);
    let [carriage, load] = crane_f32::gravity(&[0.0, 0.2]).map(f64::from);
    assert!(carriage.abs() < 1e-3 && (load.abs() - lift).abs() < 1e-3);
    // 62 kg at 1 m/s² and 3 N·s/m at 0.5 m/s.
    let [carriage, _] = crane::inverse_dynamics(&[0.0, 0.2], &[0.5, 0.0], &[1.0, 0.0]);
    assert!((carriage - (62.0 + 1.5)).abs() < 1e-9);
    // The axis of the waist is vertical: gravity does not load it.
    let q = [0.1, -0.5, 0.3, 0.0, 0.7, 0.2];
    assert!(puma560::gravity(&q)[0].abs() < 1e-9);
    assert!(puma560::inverse_dynamics(&q, &[0.0; 6], &[1.0; 6])[0] > 0.1);
}
