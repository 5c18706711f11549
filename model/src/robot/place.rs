//! Names of the parts of a robot, so that a finding can say where it is and
//! a reader can say on which line that was.

use core::fmt;

/// A part of a [`Robot`](super::Robot).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Place {
    /// The robot's name.
    Name,
    /// The gravity vector.
    Gravity,
    /// The placement of frame 0.
    Base,
    /// The placement of the hand.
    Tool,
    /// The placement of the frame of payloads.
    PayloadFrame,
    /// The list of joints as a whole.
    Joints,
    /// A field of the joint with this zero-based index.
    Joint(usize, Field),
    /// The list of frames as a whole.
    Frames,
    /// The frame with this zero-based index.
    Frame(usize),
}

/// A field of a [`Joint`](super::Joint).
///
/// The constants follow the robot file: `Offset` is what is added to q, so it
/// is the joint's `theta` if it is revolute and its `d` if it is prismatic.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Field {
    /// Its name.
    Name,
    /// Revolute or prismatic.
    Kind,
    /// Twist.
    Alpha,
    /// Turn about y after the twist.
    Beta,
    /// Where its link is at q = 0, and its axis.
    Placement,
    /// Length of the common normal.
    A,
    /// Constant d of a revolute joint.
    D,
    /// Constant theta of a prismatic joint.
    Theta,
    /// The constant that is added to q.
    Offset,
    /// Mass of the link.
    Mass,
    /// Centre of mass.
    Com,
    /// Inertia tensor.
    Inertia,
    /// Viscous damping.
    Viscous,
    /// Coulomb friction.
    Coulomb,
    /// Over which speeds its sign is smoothed.
    CoulombWidth,
    /// Rotor inertia.
    Armature,
    /// The link's own frame.
    Frame,
    /// Range of positions, of the limits.
    Position,
    /// Velocity limit.
    Velocity,
    /// Acceleration limit.
    Acceleration,
    /// Torque limit.
    Torque,
}

impl Field {
    /// Returns the key of the robot file, e.g. `mass`; of `limits` for the last four.
    pub fn key(self) -> &'static str {
        match self {
            Field::Name => "name",
            Field::Kind => "kind",
            Field::Alpha => "alpha",
            Field::Beta => "beta",
            Field::Placement => "placement",
            Field::A => "a",
            Field::D => "d",
            Field::Theta => "theta",
            Field::Offset => "offset",
            Field::Mass => "mass",
            Field::Com => "com",
            Field::Inertia => "inertia",
            Field::Viscous => "viscous",
            Field::Coulomb => "coulomb",
            Field::CoulombWidth => "coulomb_width",
            Field::Armature => "armature",
            Field::Frame => "frame",
            Field::Position => "position",
            Field::Velocity => "velocity",
            Field::Acceleration => "acceleration",
            Field::Torque => "torque",
        }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Place::Name => f.write_str("name"),
            Place::Gravity => f.write_str("gravity"),
            Place::Base => f.write_str("base"),
            Place::Tool => f.write_str("tool"),
            Place::PayloadFrame => f.write_str("payload_frame"),
            Place::Joints => f.write_str("joints"),
            Place::Frames => f.write_str("frames"),
            Place::Frame(index) => write!(f, "frame {}", index + 1),
            // People count joints from one, as the equations do.
            Place::Joint(index, field) => write!(f, "joint {}: {}", index + 1, field.key()),
        }
    }
}
