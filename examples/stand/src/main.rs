//! Prints how the weight is shared, and the account of two steps; fails if energy appears, or is lost
//! unaccounted for.

use stand::balance::command;
use stand::ground::accelerations;
use stand::walk::walk;
use stand::{BENT, LEGS, Stance, State};

fn main() {
    let state = State::at_rest();
    let standing = command(&state, Stance::Four, &state.pose, &[BENT; LEGS]);
    let (rates, forces) = accelerations(&state, Stance::Four, &standing.tau);
    println!(
        "a front foot carries {:.1} N, a rear foot {:.1} N",
        forces[2], forces[8]
    );
    assert!(rates.amax() < 1e-5, "it stands");
    let report = walk();
    let [left, right] = report.forward.map(|forward| 1e3 * forward);
    println!(
        "the front feet step by {left:.0} and {right:.0} mm, {:.0} mm high",
        1e3 * report.highest
    );
    println!(
        "the base stays within {:.0} mm of its way",
        1e3 * report.farthest[0]
    );
    println!(
        "the ground pushes each foot that stands by {:.0} N at least",
        report.least_force
    );
    println!(
        "joints gave {:.2} J, touch-downs took {:.2} J of {:.1} J",
        report.work, report.lost, report.energy
    );
    assert!(
        report.energy_error < 1e-4,
        "the energy is wrong by {} J",
        report.energy_error
    );
    println!("the account is right within 0.1 mJ");
}
