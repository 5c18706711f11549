//! What may be odd about a robot file that is right: the names of its warnings.

use core::fmt;

/// What a warning is about. A robot file that knows better says so by the name,
/// `allow = ["large_mass"]`, and hears no more of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Doubt {
    /// No body has this inertia.
    ImpossibleInertia,
    /// Gravity is not that of the Earth, nor of the other planets.
    UnusualGravity,
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
    /// Coulomb friction is smoothed over all speeds that a joint reaches.
    LargeWidth,
    /// An angle is near a multiple of π/2, but not near enough to be taken for it.
    NearRightAngle,
    /// A scene's box goes beyond the limits of a joint.
    BoxBeyondLimits,
    /// A tolerance allows an error as large as the output.
    LooseTolerance,
}

impl Doubt {
    /// All of them with their names in robot files.
    pub const WORDS: [(&'static str, Doubt); 12] = [
        ("impossible_inertia", Doubt::ImpossibleInertia),
        ("unusual_gravity", Doubt::UnusualGravity),
        ("large_length", Doubt::LargeLength),
        ("large_mass", Doubt::LargeMass),
        ("large_inertia", Doubt::LargeInertia),
        ("large_angle", Doubt::LargeAngle),
        ("large_limit", Doubt::LargeLimit),
        ("large_velocity", Doubt::LargeVelocity),
        ("large_width", Doubt::LargeWidth),
        ("near_right_angle", Doubt::NearRightAngle),
        ("box_beyond_limits", Doubt::BoxBeyondLimits),
        ("loose_tolerance", Doubt::LooseTolerance),
    ];

    /// The name in robot files.
    pub fn name(self) -> &'static str {
        let mut words = Doubt::WORDS.iter();
        let found = words.find(|(_, doubt)| *doubt == self);
        found.map_or("", |(name, _)| name)
    }
}

impl fmt::Display for Doubt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
