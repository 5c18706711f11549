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
    let (front, rear) = (forces[2], forces[8]);
    println!("a front foot carries {front:.1} N, a rear foot {rear:.1} N");
    assert!(rates.amax() < 1e-5, "it stands");
    let report = walk();
    let [left, right] = report.forward.map(|forward| 1e3 * forward);
    let [highest, farthest] = [report.highest, report.farthest[0]].map(|length| 1e3 * length);
    println!("the front feet step by {left:.0} and {right:.0} mm, {highest:.0} mm high");
    println!("the base stays within {farthest:.0} mm of its way");
    let least = report.least_force;
    println!("the ground pushes each foot that stands by {least:.0} N at least");
    let (work, lost, energy) = (report.work, report.lost, report.energy);
    println!("joints gave {work:.2} J, touch-downs took {lost:.2} J of {energy:.1} J");
    let error = report.energy_error;
    assert!(error < 1e-4, "the energy is wrong by {error} J");
    println!("the account is right within 0.1 mJ");
}
