//! Where the arm should be: every joint swings with two frequencies, so that every
//! parameter is felt.

use crate::{Joints, arm};

/// About where every joint swings, rad.
const CENTRE: Joints = [0.0, 0.4, -0.8];
/// How far at each frequency, rad.
const SWING: [Joints; 2] = [[0.6, 0.35, 0.5], [0.25, 0.15, 0.3]];
/// How fast, rad/s.
const FREQUENCY: [Joints; 2] = [[1.3, 1.7, 2.1], [3.7, 3.1, 4.3]];

/// A point of the trajectory.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// Angles, rad.
    pub q: Joints,
    /// Velocities, rad/s.
    pub qd: Joints,
    /// Accelerations, rad/s².
    pub qdd: Joints,
}

/// The target at a time, s. It starts at rest.
pub fn at(time: f64) -> Target {
    let mut target = Target {
        q: CENTRE,
        qd: [0.0; arm::N],
        qdd: [0.0; arm::N],
    };
    for (swing, frequency) in SWING.iter().zip(&FREQUENCY) {
        for i in 0..arm::N {
            let (sin, cos) = libm::sincos(frequency[i] * time);
            target.q[i] += swing[i] * (1.0 - cos);
            target.qd[i] += swing[i] * frequency[i] * sin;
            target.qdd[i] += swing[i] * frequency[i] * frequency[i] * cos;
        }
    }
    target
}
