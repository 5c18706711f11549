//! The reference trajectory: every joint swings from its start and back.

use crate::{Joints, puma560};

/// A point of the trajectory.
pub type Target = example_shared::target::Target<{ puma560::N }>;

/// Start of every joint, rad.
const START: Joints = [0.3, -0.6, 0.4, 0.2, 0.8, -0.1];
/// Half of how far it swings, rad.
const SWING: Joints = [0.6, 0.35, -0.4, 0.5, 0.3, -0.75];
/// Frequencies, rad/s.
const FREQUENCY: Joints = [1.1, 1.3, 0.9, 1.7, 1.9, 2.3];

/// Returns the target at a time, s. It starts at rest.
pub fn at(time: f64) -> Target {
    Target::resting(START).swinging(&SWING, &FREQUENCY, time)
}
