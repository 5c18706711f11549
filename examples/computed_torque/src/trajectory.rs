//! Where the arm should be: every joint swings from its start and back.

use crate::{Joints, puma560};

/// Where every joint starts, rad.
const START: Joints = [0.3, -0.6, 0.4, 0.2, 0.8, -0.1];
/// How far it swings, rad.
const SWING: Joints = [1.2, 0.7, -0.8, 1.0, 0.6, -1.5];
/// How fast, rad/s.
const FREQUENCY: Joints = [1.1, 1.3, 0.9, 1.7, 1.9, 2.3];

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
        q: START,
        qd: [0.0; puma560::N],
        qdd: [0.0; puma560::N],
    };
    for i in 0..puma560::N {
        let (half, frequency) = (SWING[i] / 2.0, FREQUENCY[i]);
        let (sin, cos) = libm::sincos(frequency * time);
        target.q[i] += half * (1.0 - cos);
        target.qd[i] = half * frequency * sin;
        target.qdd[i] = half * frequency * frequency * cos;
    }
    target
}
