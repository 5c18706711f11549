//! Prints the errors with and without learning; fails if learning does not help.

use adaptive_control::control::{Controller, GAIN};
use adaptive_control::run::run;

fn main() {
    let gains = [("does not learn", 0.0), ("learns", GAIN)];
    let [fixed, learning] = gains.map(|(name, gain)| {
        let [angle, torque] = run(Controller::new(gain), 20.0);
        println!("{name:>14}: error {angle:.1e} rad, torques of the model off by {torque:.1e} N·m");
        [angle, torque]
    });
    let is_better = |i: usize| learning[i] < fixed[i] / 10.0;
    assert!(is_better(0) && is_better(1), "learning does not help");
}
