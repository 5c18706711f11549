//! Prints when a push was noticed, and what it was found to be; fails if it is missed or its
//! size is off by more than 5 %.

use std::process::ExitCode;

use collision::{Push, simulate};

/// The part of the force by which the estimate may be off.
const TOLERANCE: f64 = 0.05;

fn main() -> ExitCode {
    let push = Push {
        during: [1.0, 2.0],
        wrench: [20.0, -15.0, 10.0, 0.0, 0.0, 0.0],
    };
    let all = simulate(&push, 2.5);
    let noticed = all.iter().find(|noticed| noticed.is_push());
    let settled = all.iter().rev().find(|noticed| noticed.time <= 1.5);
    let (Some(noticed), Some(settled)) = (noticed, settled) else {
        println!("no push was noticed");
        return ExitCode::FAILURE;
    };
    let size = |wrench: &[f64; 6]| wrench[..3].iter().map(|x| x * x).sum::<f64>().sqrt();
    let (found, given) = (size(&settled.wrench), size(&push.wrench));
    println!("pushed at 1.000 s, noticed at {:.3} s", noticed.time);
    let [x, y, z, ..] = settled.wrench;
    println!("at {:.3} s: ({x:.2}, {y:.2}, {z:.2}) N", settled.time);
    println!("{found:.2} N of {given:.2} N");
    match (found - given).abs() <= TOLERANCE * given {
        true => ExitCode::SUCCESS,
        false => ExitCode::FAILURE,
    }
}
