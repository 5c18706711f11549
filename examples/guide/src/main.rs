//! Prints what the guide shows: torques that hold, a payload found, a motion followed, and how
//! long a call takes here.

use std::hint::black_box;
use std::time::Instant;

use guide::{Joints, arm, control, hold, picking};

fn main() {
    let q = [0.3, 0.6, -0.4];
    println!("holds with      {:.3?} N·m", hold::float(&q));

    let measured = hold::measured(&[q, [0.0, 0.2, 0.9], [1.0, -0.3, 0.5]], 0.7);
    if let Some(mass) = measured.and_then(|measured| hold::mass(&measured)) {
        println!("payload         {mass:.3} kg");
    }

    println!("follows within  {:.1e} rad", control::follow(4));

    let exact = nanoseconds(arm::inverse_dynamics);
    println!("exact           {exact:.1} ns");
    let pick = nanoseconds(picking::inverse_dynamics);
    println!("to pick, at 1%  {pick:.1} ns");
}

/// Returns the time of a call, ns: the best of 20 rounds.
fn nanoseconds<T>(call: impl Fn(&Joints, &Joints, &Joints) -> T) -> f64 {
    const CALLS: u32 = 100_000;
    let mut best = f64::INFINITY;
    for _ in 0..20 {
        let start = Instant::now();
        let state = [[0.0, 0.6, -0.4], [0.0, 0.5, 0.5], [0.0, 2.0, 2.0]];
        for _ in 0..CALLS {
            // The compiler cannot know the arguments, and cannot drop the call.
            let [q, qd, qdd] = black_box(state);
            black_box(call(&q, &qd, &qdd));
        }
        best = best.min(start.elapsed().as_secs_f64() / f64::from(CALLS));
    }
    best * 1e9
}
