//! Prints the torques that hold the arms' own weight, as the page shows them.

use gravity_compensation::{open_manipulator, so101};

fn main() {
    let load = so101::gravity(&[0.0; so101::N]);
    println!("so101            {load:6.2?} N·m");
    let load = open_manipulator::gravity(&[0.0, 1.57, -1.57, 0.0]);
    println!("open_manipulator {load:6.2?} N·m");
}
