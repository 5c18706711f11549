//! The reference trajectory: every joint swings with two frequencies, so that every parameter
//! is excited.

use crate::{Joints, arm};

/// A point of the trajectory.
pub type Target = example_shared::target::Target<{ arm::N }>;

/// About where every joint swings, rad.
const CENTRE: Joints = [0.0, 0.4, -0.8];
/// Amplitudes at each frequency, rad.
const SWING: [Joints; 2] = [[0.6, 0.35, 0.5], [0.25, 0.15, 0.3]];
/// Frequencies, rad/s.
const FREQUENCY: [Joints; 2] = [[1.3, 1.7, 2.1], [3.7, 3.1, 4.3]];

/// Returns the target at a time, s. It starts at rest.
pub fn at(time: f64) -> Target {
    let [slow, fast] = [0, 1].map(|i| (&SWING[i], &FREQUENCY[i]));
    Target::resting(CENTRE)
        .swinging(slow.0, slow.1, time)
        .swinging(fast.0, fast.1, time)
}
