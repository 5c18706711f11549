//! The joint vectors that functions read, as a table.

use crate::robot::Field;

/// An argument of a generated function: an array with an entry a joint.
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
}

/// What there is to say of an argument.
struct Facts {
    name: &'static str,
    symbol: &'static str,
    noun: &'static str,
    given: Option<&'static str>,
    meaning: &'static str,
    limit: Field,
    reach: f64,
}

/// In the order of [`Argument::ALL`].
const TABLE: [Facts; Argument::COUNT] = [
    Facts {
        name: "q",
        symbol: "q",
        noun: "position",
        given: Some("q"),
        meaning: "Positions, rad or m.",
        limit: Field::Position,
        reach: 1.0,
    },
    Facts {
        name: "qd",
        symbol: "q̇",
        noun: "velocity",
        given: Some("qd"),
        meaning: "Velocities, rad/s or m/s.",
        limit: Field::Velocity,
        reach: 3.0,
    },
    Facts {
        name: "qdd",
        symbol: "q̈",
        noun: "acceleration",
        given: Some("qdd"),
        meaning: "Accelerations, rad/s² or m/s².",
        limit: Field::Acceleration,
        reach: 10.0,
    },
    Facts {
        name: "tau",
        symbol: "τ",
        noun: "torque",
        given: Some("torque"),
        meaning: "Torques, N·m or N.",
        limit: Field::Torque,
        reach: 100.0,
    },
    Facts {
        name: "v",
        symbol: "v",
        noun: "reference velocity",
        given: None,
        meaning: "Velocities wished for, rad/s or m/s.",
        limit: Field::Velocity,
        reach: 3.0,
    },
    Facts {
        name: "a",
        symbol: "a",
        noun: "reference acceleration",
        given: None,
        meaning: "Accelerations wished for, rad/s² or m/s².",
        limit: Field::Acceleration,
        reach: 10.0,
    },
];

impl Argument {
    /// How many there are.
    pub const COUNT: usize = 6;

    /// Every argument, in the order of signatures.
    pub const ALL: [Argument; Argument::COUNT] = [
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

    /// Its place in [`Argument::ALL`].
    pub fn index(self) -> usize {
        self as usize
    }

    fn facts(self) -> &'static Facts {
        &TABLE[self.index()]
    }

    /// Its name in generated code.
    pub fn name(self) -> &'static str {
        self.facts().name
    }

    /// The argument of a name in generated code.
    pub fn from_name(name: &str) -> Option<Argument> {
        Argument::ALL.into_iter().find(|a| a.name() == name)
    }

    /// Its letter in the equations.
    pub fn symbol(self) -> &'static str {
        self.facts().symbol
    }

    /// Its key in files of given states; none if these do not give it.
    pub fn given(self) -> Option<&'static str> {
        self.facts().given
    }

    /// What an entry is, in one or two words.
    pub fn noun(self) -> &'static str {
        self.facts().noun
    }

    /// A line for its documentation.
    pub fn meaning(self) -> &'static str {
        self.facts().meaning
    }

    /// The limit of a joint that says how far its entries reach.
    pub fn limit(self) -> Field {
        self.facts().limit
    }

    /// How far its entries are taken to reach where a joint has no such limit
    /// (a position that turns: half a turn).
    pub fn reach(self) -> f64 {
        self.facts().reach
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
        assert_eq!(Argument::from_name("t"), None);
    }
}
