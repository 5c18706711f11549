//! Prints when a push was noticed and its estimated force; fails if the push is missed or the
//! size of the force is wrong by more than 5 %.

use collision::{PERIOD, Push, THRESHOLD, simulate};

fn main() {
    let push = Push {
        during: 1.0..2.0,
        wrench: [20.0, -15.0, 10.0, 0.0, 0.0, 0.0],
    };
    let samples = simulate(&push, 2.5);
    let noticed = samples.iter().find(|noticed| noticed.torque > THRESHOLD);
    let noticed = noticed.expect("a push is noticed");
    println!("pushed at 1.000 s, noticed at {:.3} s", noticed.time);
    // After 1.5 s.
    let settled = &samples[(1.5 / PERIOD) as usize - 1];
    let [x, y, z, ..] = settled.wrench;
    println!("at {:.3} s: ({x:.2}, {y:.2}, {z:.2}) N", settled.time);
    let size = |wrench: &[f64; 6]| wrench[..3].iter().map(|x| x * x).sum::<f64>().sqrt();
    let (estimate, force) = (size(&settled.wrench), size(&push.wrench));
    println!("{estimate:.2} N of {force:.2} N");
    assert!((estimate - force).abs() <= 0.05 * force);
}
