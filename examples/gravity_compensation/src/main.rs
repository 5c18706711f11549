//! What the arms carry of their own weight: the numbers of the guide.

use gravity_compensation::{open_manipulator, so101};

fn main() {
    println!(
        "so101            {:6.2?} N·m",
        so101::gravity(&[0.0; so101::N])
    );
    let level = [0.0, 1.57, -1.57, 0.0];
    println!(
        "open_manipulator {:6.2?} N·m",
        open_manipulator::gravity(&level)
    );
}
