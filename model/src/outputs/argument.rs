//! The joint vectors that functions read.

/// An argument of a generated function: an array with an entry a joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Argument {
    /// q
    Position,
    /// q̇
    Velocity,
    /// q̈
    Acceleration,
}

impl Argument {
    /// Every argument, in the order of signatures.
    pub const ALL: [Argument; 3] = [
        Argument::Position,
        Argument::Velocity,
        Argument::Acceleration,
    ];

    /// Its name in generated code.
    pub fn name(self) -> &'static str {
        match self {
            Argument::Position => "q",
            Argument::Velocity => "qd",
            Argument::Acceleration => "qdd",
        }
    }

    /// Its letter in the equations.
    pub fn symbol(self) -> &'static str {
        match self {
            Argument::Position => "q",
            Argument::Velocity => "q̇",
            Argument::Acceleration => "q̈",
        }
    }
}
