//! Prints the errors with and without learning; fails if learning does not help.

use std::process::ExitCode;

use adaptive_control::control::Controller;
use adaptive_control::run;

fn main() -> ExitCode {
    let mut errors = Vec::new();
    for (name, controller) in [
        ("does not learn", Controller::fixed()),
        ("learns", Controller::adaptive()),
    ] {
        let run = run(controller, 20.0);
        let error = run.at_last(|sample| sample.error);
        let torque = run.at_last(|sample| sample.torque_error);
        println!("{name:>14}: error {error:.1e} rad, torques of the model off by {torque:.1e} N·m");
        errors.push(error);
    }
    match errors[1] < errors[0] / 10.0 {
        true => ExitCode::SUCCESS,
        false => ExitCode::FAILURE,
    }
}
