//! What the guide prints: torques that hold, a payload found, a motion followed, and
//! how long a call takes here.

use std::hint::black_box;
use std::time::Instant;

use guide::{arm, control, hold, payload, picking, with_a_kilogram};

fn main() {
    let q = [0.3, 0.6, -0.4];
    println!("holds with      {:.3?} N·m", hold::float(&q));

    // What sensors would say of 0.7 kg: a fraction between empty and a kilogram.
    let poses = [q, [0.0, 0.2, 0.9], [1.0, -0.3, 0.5]];
    let measured = poses.map(|q| {
        let (empty, loaded) = (arm::gravity(&q), with_a_kilogram::gravity(&q));
        let tau = std::array::from_fn(|i| empty[i] + 0.7 * (loaded[i] - empty[i]));
        (q, tau)
    });
    println!("payload         {:.3?} kg", payload::mass(&measured));

    println!("follows within  {:.1e} rad", control::follow(4));

    let (qd, qdd) = ([0.5; 3], [2.0; 3]);
    println!(
        "exact           {:.1} ns",
        nanoseconds(|q| arm::inverse_dynamics(q, &qd, &qdd)[2])
    );
    println!(
        "to pick, at 1%  {:.1} ns",
        nanoseconds(|q| picking::inverse_dynamics(q, &qd, &qdd)[1])
    );
}

/// The time of a call, the best of some rounds.
fn nanoseconds(call: impl Fn(&[f64; 3]) -> f64) -> f64 {
    const CALLS: u32 = 100_000;
    let mut best = f64::INFINITY;
    for _ in 0..20 {
        let start = Instant::now();
        let mut q = [0.0, 0.6, -0.4];
        for _ in 0..CALLS {
            q[1] = black_box(q[1]);
            black_box(call(&q));
        }
        best = best.min(start.elapsed().as_secs_f64() / f64::from(CALLS));
    }
    best * 1e9
}
