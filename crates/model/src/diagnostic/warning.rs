//! The names of warnings about robots.

use core::fmt;

/// The name of a warning about a robot file, which silences it there: `allow = ["large_mass"]`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum RobotWarning {
    /// No body has this inertia.
    ImpossibleInertia,
    /// Gravity is not that of the Earth, nor of the other planets.
    UnusualGravity,
    /// Gravity points along the base's z, upwards.
    UpwardGravity,
    /// A length looks like millimetres.
    LargeLength,
    /// A mass looks like grams.
    LargeMass,
    /// An inertia looks like kg·mm².
    LargeInertia,
    /// An angle looks like degrees.
    LargeAngle,
    /// A limit of position looks like degrees.
    LargeLimit,
    /// A limit of velocity looks like degrees or millimetres a second.
    LargeVelocity,
    /// A limit of velocity or acceleration is zero.
    ZeroLimit,
    /// Coulomb friction is smoothed over all speeds that a joint reaches.
    LargeWidth,
    /// An angle is near a multiple of π/2, but not near enough to be taken for it.
    NearRightAngle,
    /// A scene's box goes beyond the limits of a joint.
    BoxBeyondLimits,
    /// A tolerance allows an error as large as the output.
    LooseTolerance,
}

impl RobotWarning {
    /// All of them with their names in robot files.
    pub const WORDS: [(&'static str, RobotWarning); 14] = [
        ("impossible_inertia", RobotWarning::ImpossibleInertia),
        ("unusual_gravity", RobotWarning::UnusualGravity),
        ("upward_gravity", RobotWarning::UpwardGravity),
        ("large_length", RobotWarning::LargeLength),
        ("large_mass", RobotWarning::LargeMass),
        ("large_inertia", RobotWarning::LargeInertia),
        ("large_angle", RobotWarning::LargeAngle),
        ("large_limit", RobotWarning::LargeLimit),
        ("large_velocity", RobotWarning::LargeVelocity),
        ("zero_limit", RobotWarning::ZeroLimit),
        ("large_width", RobotWarning::LargeWidth),
        ("near_right_angle", RobotWarning::NearRightAngle),
        ("box_beyond_limits", RobotWarning::BoxBeyondLimits),
        ("loose_tolerance", RobotWarning::LooseTolerance),
    ];

    /// Returns the name in robot files.
    pub fn name(self) -> &'static str {
        let mut words = RobotWarning::WORDS.iter();
        let entry = words.find(|(_, warning)| *warning == self);
        entry.map_or("", |(name, _)| name)
    }
}

impl fmt::Display for RobotWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
