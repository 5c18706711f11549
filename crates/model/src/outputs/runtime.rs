//! Parameters that are arguments where somebody asks for that: gravity, and what the hand carries.

use alloc::vec::Vec;

use super::formula::Formula;
use super::quantity::Facts;
use super::{Argument, Axis, Shape, Written};
use crate::equations::load::Loading;
use crate::scalar::Divide;

/// A parameter of the arm that generated functions can take as an argument.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum RuntimeParameter {
    /// A body that is fixed to the last link: its regrouped parameters are the argument `load`.
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

/// The load that a payload is: regrouped parameters that stand where constants stood elsewhere.
pub(super) struct Load;

impl Formula for Load {
    const FACTS: Facts = Facts {
        field: "load",
        letter: "load",
        summary: "The regrouped parameters that a payload changes.",
        arguments: &[Argument::Payload],
        shape: Shape(&[Axis::Load]),
        ..Facts::PLAIN
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let loading = at.motion.loading.as_ref();
        loading.map_or_else(Vec::new, Loading::load)
    }
}
