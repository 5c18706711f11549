//! Parameters that are arguments where somebody asks for that: gravity, what the hand carries, and the
//! links' bodies and drives.

use alloc::vec::Vec;

use super::formula::Formula;
use super::quantity::Facts;
use super::{Argument, Axis, Shape, Written};
use crate::equations::load::LoadArguments;
use crate::scalar::Divide;

/// A parameter of the arm that generated functions can take as an argument.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum RuntimeParameter {
    /// The bodies of links: their regrouped parameters are the argument `load`.
    Bodies,
    /// The rotors' inertias: in `load` as well.
    Armature,
    /// The coefficients of viscous friction: in `load` as well.
    Viscous,
    /// A body that is fixed to the last link: in `load` as well.
    Payload,
    /// The acceleration of gravity in base axes: the argument `g`.
    Gravity,
}

impl RuntimeParameter {
    /// All of them.
    pub const ALL: [RuntimeParameter; 5] = [
        RuntimeParameter::Bodies,
        RuntimeParameter::Armature,
        RuntimeParameter::Viscous,
        RuntimeParameter::Payload,
        RuntimeParameter::Gravity,
    ];

    /// Those that functions take as the argument `load`.
    pub const LOADING: [RuntimeParameter; 4] = *RuntimeParameter::ALL.first_chunk().unwrap();

    /// Returns its name in the macro and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            RuntimeParameter::Bodies => "bodies",
            RuntimeParameter::Armature => "armature",
            RuntimeParameter::Viscous => "viscous",
            RuntimeParameter::Payload => "payload",
            RuntimeParameter::Gravity => "gravity",
        }
    }

    /// Returns the argument by which functions take it.
    pub fn argument(self) -> Argument {
        match self {
            RuntimeParameter::Gravity => Argument::Gravity,
            _ => Argument::Load,
        }
    }

    /// Returns the argument of the function `load` that gives it; `None` of gravity.
    pub fn given(self) -> Option<Argument> {
        Some(match self {
            RuntimeParameter::Bodies => Argument::Bodies,
            RuntimeParameter::Armature => Argument::Armature,
            RuntimeParameter::Viscous => Argument::Viscous,
            RuntimeParameter::Payload => Argument::Payload,
            RuntimeParameter::Gravity => return None,
        })
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

/// The load that bodies and drives are: regrouped parameters that stand where constants stood elsewhere.
pub(super) struct Load;

impl Formula for Load {
    const FACTS: Facts = Facts {
        field: "load",
        letter: "load",
        summary: "The regrouped parameters that depend on arguments.",
        arguments: &[
            Argument::Payload,
            Argument::Bodies,
            Argument::Armature,
            Argument::Viscous,
        ],
        shape: Shape(&[Axis::Load]),
        ..Facts::PLAIN
    };

    fn written<S: Divide>(at: &Written<'_, S>) -> Vec<S> {
        let loading = at.motion.loading.as_ref();
        loading.map_or_else(Vec::new, LoadArguments::load)
    }
}
