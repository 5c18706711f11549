//! The inputs of a program.

use crate::function::Argument;

/// An input of a program. Joints are zero-based.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Input {
    /// The sine of a joint's angle.
    Sin(usize),
    /// The cosine of a joint's angle.
    Cos(usize),
    /// 1/√(q̇² + w²) of a joint with Coulomb friction, w being its width.
    PerSpeed(usize),
    /// An entry of an argument, of most a joint's; of q that of a prismatic joint.
    Entry(Argument, usize),
}

impl Input {
    pub(crate) fn name(self) -> String {
        match self {
            Input::Sin(joint) => format!("s{}", joint + 1),
            Input::Cos(joint) => format!("c{}", joint + 1),
            Input::PerSpeed(joint) => format!("r{}", joint + 1),
            Input::Entry(argument, index) => format!("{}[{index}]", argument.name()),
        }
    }

    /// Returns the argument that it is made from.
    pub fn argument(self) -> Argument {
        match self {
            Input::Sin(_) | Input::Cos(_) => Argument::Position,
            Input::PerSpeed(_) => Argument::Velocity,
            Input::Entry(argument, _) => argument,
        }
    }

    /// Returns the joint whose sine or cosine it is.
    pub fn angle(self) -> Option<usize> {
        match self {
            Input::Sin(joint) | Input::Cos(joint) => Some(joint),
            _ => None,
        }
    }
}
