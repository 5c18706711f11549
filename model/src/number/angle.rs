//! Angles, kept exact.

use super::Rational;

/// An angle as the robot file gives it.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Angle {
    /// A rational multiple of π: `"pi/2"` is ½, `"90deg"` is ½ as well.
    PiTimes(Rational),
    /// A rational number of radians.
    Radians(Rational),
}

impl Default for Angle {
    fn default() -> Self {
        use num_traits::Zero;
        Angle::PiTimes(Rational::zero())
    }
}
