//! Parameters that are arguments where somebody asks for that: gravity, and what the hand carries.

use super::Argument;

/// A parameter of the arm that generated functions can take as an argument.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum RuntimeParameter {
    /// A body that is fixed to the last link: its regrouped parameters are the
    /// argument `load`, and a function of that name computes them.
    Payload,
    /// The acceleration of gravity in base axes: the argument `g`.
    Gravity,
}

impl RuntimeParameter {
    /// All of them.
    pub const ALL: [RuntimeParameter; 2] = [RuntimeParameter::Payload, RuntimeParameter::Gravity];

    /// Returns its name in the macro and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            RuntimeParameter::Payload => "payload",
            RuntimeParameter::Gravity => "gravity",
        }
    }

    /// Returns the argument by which functions take it.
    pub fn argument(self) -> Argument {
        match self {
            RuntimeParameter::Payload => Argument::Load,
            RuntimeParameter::Gravity => Argument::Gravity,
        }
    }
}

/// The dependence of a quantity on a payload, the least first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum PayloadDependence {
    /// Nothing.
    None,
    /// It depends on what joints feel of a payload.
    Torque,
    /// It depends on more of a payload than what joints feel.
    Full,
}
