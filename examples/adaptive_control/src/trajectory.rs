//! The reference trajectory: every joint swings with two frequencies, so that every parameter
//! is excited.

use crate::{Joints, arm};

/// A point of a trajectory of joints.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// Positions, rad.
    pub q: Joints,
    /// Velocities, rad/s.
    pub qd: Joints,
    /// Accelerations, rad/s².
    pub qdd: Joints,
}

/// About where every joint swings, rad.
const CENTRE: Joints = [0.0, 0.4, -0.8];
/// Amplitudes at each frequency, rad.
const SWING: [Joints; 2] = [[0.6, 0.35, 0.5], [0.25, 0.15, 0.3]];
/// Frequencies, rad/s.
const FREQUENCY: [Joints; 2] = [[1.3, 1.7, 2.1], [3.7, 3.1, 4.3]];

/// Returns the target at a time, s: each frequency adds amplitude (1 − cos ωt), so that the motion
/// starts at rest.
pub fn at(time: f64) -> Target {
    let mut target = Target {
        q: CENTRE,
        qd: [0.0; arm::N],
        qdd: [0.0; arm::N],
    };
    for (swing, frequency) in SWING.iter().zip(&FREQUENCY) {
        for i in 0..arm::N {
            let (amplitude, frequency) = (swing[i], frequency[i]);
            let (sin, cos) = libm::sincos(frequency * time);
            target.q[i] += amplitude * (1.0 - cos);
            target.qd[i] += amplitude * frequency * sin;
            target.qdd[i] += amplitude * frequency * frequency * cos;
        }
    }
    target
}
