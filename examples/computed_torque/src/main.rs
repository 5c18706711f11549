//! Prints the tracking errors; fails if the arm that the model describes is
//! not held on its trajectory.

use std::process::ExitCode;

use computed_torque::plant::Plant;
use computed_torque::simulate;

/// The largest error that counts as tracking, rad.
const TOLERANCE: f64 = 1e-4;

fn main() -> ExitCode {
    let mut good = true;
    for (plant, known) in [(Plant::Nominal, true), (Plant::Loaded, false)] {
        let run = simulate(plant, 0.5, 4.0);
        let held = run.tracking() < TOLERANCE;
        println!(
            "{plant:?}: holding {:.1e} rad, tracking {:.1e} rad, {}",
            run.holding,
            run.tracking(),
            if held { "held" } else { "not held" }
        );
        good &= held == known;
    }
    if good {
        ExitCode::SUCCESS
    } else {
        ExitCode::FAILURE
    }
}
