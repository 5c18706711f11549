//! Arguments of functions: joint vectors, and parameters that are arguments where somebody asks for
//! that: gravity, what the hand carries, and the links' bodies and drives.

use alloc::vec::Vec;

use super::formula::Formula;
use super::quantity::Facts;
use super::{Axis, Shape, Sizes, Written};
use crate::equations::load::{BODY, LoadArguments};
use crate::robot::Limit;
use crate::scalar::Divide;

/// An argument of a generated function: an array, of most with an entry a joint or a coordinate.
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
    /// The regrouped parameters that depend on arguments.
    Load,
    /// A payload's mass, centre of mass and inertia.
    Payload,
    /// A wrench that acts on the hand.
    Wrench,
    /// λ², which keeps an inverse finite where the arm is singular.
    Damping,
    /// λ: the weight of each torque, or acceleration, in the sum that is differentiated twice.
    Multiplier,
    /// The mass, the centre of mass and the inertia of links, ten numbers each.
    Bodies,
    /// The rotors' inertias, one a row.
    Armature,
    /// The coefficients of viscous friction, one a row.
    Viscous,
}

impl Argument {
    /// The number of arguments.
    pub const COUNT: usize = 15;

    /// Every argument, in the order of signatures; [`Argument::JOINTS`] are its beginning.
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
        Argument::Bodies,
        Argument::Armature,
        Argument::Viscous,
    ];

    /// Those with an entry a joint, which a motion is made of: the first six.
    pub const JOINTS: [Argument; 6] = *Argument::ALL.first_chunk().unwrap();

    /// The state that a box bounds: position, velocity and acceleration.
    pub const STATE: [Argument; 3] = *Argument::ALL.first_chunk().unwrap();

    /// Returns its place in [`Argument::ALL`].
    pub fn index(self) -> usize {
        self as usize
    }

    /// Returns its name in generated code.
    pub fn name(self) -> &'static str {
        self.names()[0]
    }

    /// Returns its name in generated code, and its letter in the equations.
    fn names(self) -> [&'static str; 2] {
        match self {
            Argument::Position => ["q", "q"],
            Argument::Velocity => ["qd", "q̇"],
            Argument::Acceleration => ["qdd", "q̈"],
            Argument::Torque => ["tau", "τ"],
            Argument::ReferenceVelocity => ["v", "v"],
            Argument::ReferenceAcceleration => ["a", "a"],
            Argument::Gravity => ["g", "g"],
            Argument::Load => ["load", "load"],
            Argument::Bodies => ["bodies", "bodies"],
            Argument::Armature => ["armature", "armature"],
            Argument::Viscous => ["viscous", "viscous"],
            Argument::Payload => ["payload", "payload"],
            Argument::Wrench => ["wrench", "w"],
            Argument::Damping => ["damping", "λ²"],
            Argument::Multiplier => ["multiplier", "λ"],
        }
    }

    /// Returns the argument of a name in generated code.
    pub fn from_name(name: &str) -> Option<Argument> {
        Argument::ALL.into_iter().find(|a| a.name() == name)
    }

    /// True if it has a type of its own in generated code, so that it is not confused with another.
    pub fn has_type(self) -> bool {
        matches!(self, Argument::Load | Argument::Payload | Argument::Bodies)
    }

    /// Returns its letter in the equations.
    pub fn symbol(self) -> &'static str {
        self.names()[1]
    }

    /// Returns its key in files of given states; none if these do not give it.
    pub fn given(self) -> Option<&'static str> {
        use Argument::{Acceleration, Damping, Multiplier, Position, Torque, Velocity, Wrench};
        match self {
            Torque => Some("torque"),
            Wrench => Some("hand_wrench"),
            Position | Velocity | Acceleration | Damping | Multiplier => Some(self.name()),
            _ => None,
        }
    }

    /// Returns a line for its documentation.
    pub fn meaning(self) -> &'static str {
        match self {
            Argument::Position => "Positions, rad or m.",
            Argument::Velocity => "Velocities, rad/s or m/s.",
            Argument::Acceleration => "Accelerations, rad/s² or m/s².",
            Argument::Torque => "Torques, N·m or N.",
            Argument::ReferenceVelocity => "Velocities wished for, rad/s or m/s.",
            Argument::ReferenceAcceleration => "Accelerations wished for, rad/s² or m/s².",
            Argument::Gravity => {
                "Acceleration of gravity in base axes, m/s²; where the base moves, less that of the base."
            }
            Argument::Load => "What `load` returns.",
            Argument::Bodies => "Mass, centre of mass and inertia of links.",
            Argument::Armature => "Inertias of rotors, kg·m² or kg.",
            Argument::Viscous => "Viscous friction, N·m·s/rad or N·s/m.",
            Argument::Payload => "Mass, centre of mass and inertia of what the hand carries.",
            Argument::Wrench => {
                "Force in N over moment in N·m that act on the frame, in its axes and about its point."
            }
            Argument::Damping => {
                "λ², zero or more, which is added to the diagonal before an inverse is taken."
            }
            Argument::Multiplier => {
                "λ, by how much each joint counts: Lagrange multipliers, or the slope of a cost to go."
            }
        }
    }

    /// Returns how many entries it has.
    pub fn length(self, sizes: Sizes) -> usize {
        match self {
            Argument::Gravity => 3,
            Argument::Load => sizes.load,
            Argument::Bodies => BODY * sizes.bodies,
            Argument::Armature | Argument::Viscous => sizes.table,
            Argument::Payload => BODY,
            Argument::Wrench => 6,
            Argument::Damping => 1,
            Argument::Position => sizes.joints,
            _ => sizes.coordinates(),
        }
    }

    /// Returns the limit of a joint that says how far its entries reach, if they are of joints.
    pub fn limit(self) -> Option<Limit> {
        match self {
            Argument::Position => Some(Limit::Position),
            Argument::Velocity | Argument::ReferenceVelocity => Some(Limit::Velocity),
            Argument::Acceleration | Argument::ReferenceAcceleration => Some(Limit::Acceleration),
            Argument::Torque => Some(Limit::Torque),
            _ => None,
        }
    }

    /// Returns how far its entries reach where a joint has no such limit (a turn: half a turn).
    pub fn reach(self) -> f64 {
        match self {
            Argument::Velocity | Argument::ReferenceVelocity => 3.0,
            Argument::Acceleration | Argument::ReferenceAcceleration => 10.0,
            Argument::Torque | Argument::Wrench => 100.0,
            Argument::Gravity => 9.81,
            _ => 1.0,
        }
    }

    /// Returns the least that an entry is taken to be where a joint has no such limit.
    pub fn least(self) -> f64 {
        match self {
            Argument::Damping => 0.0,
            _ => -self.reach(),
        }
    }
}

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_are_in_order() {
        for (index, argument) in Argument::ALL.into_iter().enumerate() {
            assert_eq!(argument.index(), index);
            assert_eq!(Argument::from_name(argument.name()), Some(argument));
        }
        let (two, three) = (Sizes::whole(2), Sizes::whole(3));
        let of_joints = |argument: &Argument| argument.length(two) != argument.length(three);
        let motion = Argument::JOINTS.into_iter();
        let arguments = Argument::ALL.into_iter().filter(of_joints);
        let of_drives = [Argument::Multiplier, Argument::Armature, Argument::Viscous];
        assert!(arguments.eq(motion.chain(of_drives)));
        assert_eq!(Argument::from_name("t"), None);
    }
}
