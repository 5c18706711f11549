//! What functions read, as a table: joint vectors, and parameters that are
//! arguments where somebody asks for that.

use super::Sizes;
use crate::equations::load::PAYLOAD;
use crate::robot::Limit;

/// An argument of a generated function: an array, of most with an entry a joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Argument {
    /// q
    Position,
    /// q̇
    Velocity,
    /// q̈
    Acceleration,
    /// τ
    Torque,
    /// A velocity v that a controller wishes for.
    ReferenceVelocity,
    /// An acceleration a that a controller wishes for.
    ReferenceAcceleration,
    /// The acceleration of gravity, where it is an argument.
    Gravity,
    /// The regrouped parameters that a payload changes.
    Load,
    /// A payload's mass, centre of mass and inertia.
    Payload,
    /// A wrench that acts on the hand.
    Wrench,
    /// λ², which keeps an inverse finite where the arm is singular.
    Damping,
    /// λ: by how much each torque, or acceleration, counts in what is differentiated twice.
    Multiplier,
}

/// The number of entries of an argument.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Length {
    /// One a joint.
    Joints,
    /// So many, whatever the arm.
    Fixed(usize),
    /// As many as the arm has regrouped parameters that a payload changes.
    Load,
}

/// The facts of an argument.
struct Facts {
    name: &'static str,
    symbol: &'static str,
    given: Option<&'static str>,
    meaning: &'static str,
    length: Length,
    limit: Option<Limit>,
    reach: f64,
}

/// In the order of [`Argument::ALL`].
const TABLE: [Facts; Argument::COUNT] = [
    Facts {
        name: "q",
        symbol: "q",
        given: Some("q"),
        meaning: "Positions, rad or m.",
        length: Length::Joints,
        limit: Some(Limit::Position),
        reach: 1.0,
    },
    Facts {
        name: "qd",
        symbol: "q̇",
        given: Some("qd"),
        meaning: "Velocities, rad/s or m/s.",
        length: Length::Joints,
        limit: Some(Limit::Velocity),
        reach: 3.0,
    },
    Facts {
        name: "qdd",
        symbol: "q̈",
        given: Some("qdd"),
        meaning: "Accelerations, rad/s² or m/s².",
        length: Length::Joints,
        limit: Some(Limit::Acceleration),
        reach: 10.0,
    },
    Facts {
        name: "tau",
        symbol: "τ",
        given: Some("torque"),
        meaning: "Torques, N·m or N.",
        length: Length::Joints,
        limit: Some(Limit::Torque),
        reach: 100.0,
    },
    Facts {
        name: "v",
        symbol: "v",
        given: None,
        meaning: "Velocities wished for, rad/s or m/s.",
        length: Length::Joints,
        limit: Some(Limit::Velocity),
        reach: 3.0,
    },
    Facts {
        name: "a",
        symbol: "a",
        given: None,
        meaning: "Accelerations wished for, rad/s² or m/s².",
        length: Length::Joints,
        limit: Some(Limit::Acceleration),
        reach: 10.0,
    },
    Facts {
        name: "g",
        symbol: "g",
        given: None,
        meaning: "Acceleration of gravity in base axes, m/s²; where the base moves, less that of the base.",
        length: Length::Fixed(3),
        limit: None,
        reach: 9.81,
    },
    Facts {
        name: "load",
        symbol: "load",
        given: None,
        meaning: "What `load` returns of what the hand carries.",
        length: Length::Load,
        limit: None,
        reach: 1.0,
    },
    Facts {
        name: "payload",
        symbol: "payload",
        given: None,
        meaning: "Mass, centre of mass and inertia of what the hand carries.",
        length: Length::Fixed(PAYLOAD),
        limit: None,
        reach: 1.0,
    },
    Facts {
        name: "wrench",
        symbol: "w",
        given: Some("hand_wrench"),
        meaning: "Force in N over moment in N·m that act on the frame, in its axes and about its point.",
        length: Length::Fixed(6),
        limit: None,
        reach: 100.0,
    },
    Facts {
        name: "damping",
        symbol: "λ²",
        given: Some("damping"),
        meaning: "λ², zero or more, which is added to the diagonal before an inverse is taken.",
        length: Length::Fixed(1),
        limit: None,
        reach: 1.0,
    },
    Facts {
        name: "multiplier",
        symbol: "λ",
        given: Some("multiplier"),
        meaning: "λ, by how much each joint counts: Lagrange multipliers, or the slope of a cost to go.",
        length: Length::Joints,
        limit: None,
        reach: 1.0,
    },
];

impl Argument {
    /// The number of arguments.
    pub const COUNT: usize = 12;

    /// Every argument, in the order of signatures.
    pub const ALL: [Argument; Argument::COUNT] = [
        Argument::Position,
        Argument::Velocity,
        Argument::Acceleration,
        Argument::Torque,
        Argument::ReferenceVelocity,
        Argument::ReferenceAcceleration,
        Argument::Gravity,
        Argument::Load,
        Argument::Payload,
        Argument::Wrench,
        Argument::Damping,
        Argument::Multiplier,
    ];

    /// Those with an entry a joint, which a motion is made of.
    pub const JOINTS: [Argument; 6] = [
        Argument::Position,
        Argument::Velocity,
        Argument::Acceleration,
        Argument::Torque,
        Argument::ReferenceVelocity,
        Argument::ReferenceAcceleration,
    ];

    /// The state that a box bounds: position, velocity and acceleration.
    pub const STATE: [Argument; 3] = [
        Argument::Position,
        Argument::Velocity,
        Argument::Acceleration,
    ];

    /// Returns its place in [`Argument::ALL`].
    pub fn index(self) -> usize {
        self as usize
    }

    fn facts(self) -> &'static Facts {
        &TABLE[self.index()]
    }

    /// Returns its name in generated code.
    pub fn name(self) -> &'static str {
        self.facts().name
    }

    /// Returns the argument of a name in generated code.
    pub fn from_name(name: &str) -> Option<Argument> {
        Argument::ALL.into_iter().find(|a| a.name() == name)
    }

    /// Returns its letter in the equations.
    pub fn symbol(self) -> &'static str {
        self.facts().symbol
    }

    /// Returns its key in files of given states; none if these do not give it.
    pub fn given(self) -> Option<&'static str> {
        self.facts().given
    }

    /// Returns a line for its documentation.
    pub fn meaning(self) -> &'static str {
        self.facts().meaning
    }

    /// Returns how many entries it has.
    pub fn length(self, sizes: Sizes) -> usize {
        match self.facts().length {
            Length::Joints => sizes.joints,
            Length::Fixed(length) => length,
            Length::Load => sizes.load,
        }
    }

    /// Returns the limit of a joint that says how far its entries reach; none where
    /// they are no joint's.
    pub fn limit(self) -> Option<Limit> {
        self.facts().limit
    }

    /// Returns how far its entries are taken to reach where a joint has no such
    /// limit (a position that turns: half a turn).
    pub fn reach(self) -> f64 {
        self.facts().reach
    }

    /// Returns the least that an entry is taken to be where a joint has no such limit.
    pub fn least(self) -> f64 {
        match self {
            Argument::Damping => 0.0,
            _ => -self.reach(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_is_in_order() {
        for (index, argument) in Argument::ALL.into_iter().enumerate() {
            assert_eq!(argument.index(), index);
            assert_eq!(Argument::from_name(argument.name()), Some(argument));
        }
        let of_joints = |argument: &Argument| argument.facts().length == Length::Joints;
        let motion = Argument::JOINTS.into_iter();
        let all = Argument::ALL.into_iter().filter(of_joints);
        assert!(all.eq(motion.chain([Argument::Multiplier])));
        assert_eq!(Argument::from_name("t"), None);
    }
}
