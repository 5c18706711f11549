//! Constant placements of one frame in another.

use num_traits::{Signed, Zero};

use crate::number::{Angle, Rational};

/// A pose of a frame in another: its origin at `xyz`, its axes turned by `rpy`.
///
/// The angles are those of URDF: about the fixed axes x, y and z of the other
/// frame, in this order, so that R = Rz(yaw) Ry(pitch) Rx(roll).
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct Placement {
    /// The origin, m.
    pub xyz: [Rational; 3],
    /// Roll, pitch and yaw.
    pub rpy: [Angle; 3],
}

impl Placement {
    /// Returns whether it moves nothing.
    pub fn is_identity(&self) -> bool {
        self.xyz.iter().all(Zero::is_zero) && self.rpy.iter().all(Angle::is_zero)
    }

    /// Returns |x| + |y| + |z|, in metres: the scale of errors of lengths that are computed from it.
    pub fn size(&self) -> Rational {
        self.xyz.iter().map(Signed::abs).sum()
    }

    /// Returns the placement, unless it moves nothing: one that is left out says the
    /// same.
    pub fn unless_identity(self) -> Option<Self> {
        (!self.is_identity()).then_some(self)
    }
}
