//! Scenes: what a robot is used for, so that nothing else is computed.
//!
//! - this file: [`Scene`], as the robot file has it
//! - `apply`: the robot that a scene makes of a robot
//! - `validate`: checks of scenes, from files and from code ([`Scene::validate`])
//! - `write`: the text that says the same ([`write`](write())), and its hash

mod apply;
mod validate;
mod write;

use alloc::string::String;
use alloc::vec::Vec;

use crate::number::Rational;
use crate::outputs::Function;
use crate::robot::values::word;
use crate::robot::{BodyRange, Limit, Parent, Position, Robot};

pub use crate::placed::Body as Payload;
pub use write::write;

/// A use of a robot. Joints are zero-based here; people count from one.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct Scene {
    /// Its name; the generated module is called after robot and scene.
    pub name: String,
    /// The functions wanted; empty if the scene leaves that to the request.
    pub outputs: Vec<Function>,
    /// The joints whose torques are wanted, in this order; `None` for every
    /// joint that is not locked. Every quantity has these rows *and* columns.
    pub joints: Option<Vec<usize>>,
    /// Joints that stay where they are, with their positions, in the order of the file.
    pub lock: Vec<(usize, Position)>,
    /// True if a base that floats stays at rest. Gravity is then in its axes, as of a fixed base.
    pub lock_base: bool,
    /// Instead of the robot's.
    pub gravity: Option<[Rational; 3]>,
    /// q̇ = 0: the velocity terms vanish, and so does the argument.
    pub velocity_zero: bool,
    /// q̈ = 0: the same for accelerations.
    pub acceleration_zero: bool,
    /// The payload on the last link, in the [`payload_frame`](crate::robot::Robot::payload_frame).
    pub payload: Option<Payload>,
    /// The link that holds the payload, in that link's frame, where links have several ends.
    pub payload_link: Option<Parent>,
    /// The ranges of the motion, instead of the robot's limits.
    pub bounds: MotionBox,
    /// The accuracy that may be given up.
    pub tolerance: Option<Tolerance>,
    /// The scalar; `None` if the scene leaves that to the request.
    pub scalar: Option<SceneScalar>,
}

/// Ranges of motion, an entry a joint, and of the payload; what is missing is the robot's limit. Of
/// rates where the base floats, an entry a coordinate: six of the base come first.
///
/// A range of positions that the joint can never take is an error; one beyond the robot's limits a
/// warning: it is where bounds hold, not where the joint can go. A rate may be zero: at rest.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct MotionBox {
    /// Lowest and highest positions.
    pub position: Option<Vec<[Position; 2]>>,
    /// Largest |q̇|.
    pub velocity: Option<Vec<Rational>>,
    /// Largest |q̈|.
    pub acceleration: Option<Vec<Rational>>,
    /// The payloads, where a payload is an argument.
    pub payload: Option<BodyRange>,
}

impl MotionBox {
    pub(crate) fn rate(&self, rate: Limit) -> Option<&Vec<Rational>> {
        match rate {
            Limit::Velocity => self.velocity.as_ref(),
            Limit::Acceleration => self.acceleration.as_ref(),
            Limit::Position | Limit::Torque => None,
        }
    }
}

/// The largest error of a torque over the box.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Tolerance {
    /// Relative to the scale; one for all joints, or one a joint of the robot.
    pub value: Vec<Rational>,
    /// The scale that the values are relative to.
    pub relative_to: Scale,
}

impl Tolerance {
    /// Returns the tolerance of a joint, zero-based.
    pub fn of(&self, joint: usize) -> Option<&Rational> {
        match self.value.as_slice() {
            [tolerance] => Some(tolerance),
            tolerances => tolerances.get(joint),
        }
    }
}

/// The scale T_i of a joint's torque.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Scale {
    /// The actuator's torque limit, above zero. An entry of D or of h_ikm is relative to what alone
    /// takes that limit at the largest rates of the box: min(T_i/q̈_k, T_k/q̈_i), T_i/(q̇_k q̇_m).
    Actuator,
    /// A size that the model's own result attains on the box: it is found by
    /// climbing from actual states, so at its largest or just below.
    Range,
}

impl Scale {
    /// Every scale with the word that robot files use for it.
    pub const WORDS: [(&'static str, Self); 2] =
        [("actuator", Scale::Actuator), ("range", Scale::Range)];

    /// Returns its word.
    pub fn word(self) -> &'static str {
        word(&Scale::WORDS, &self)
    }
}

/// The scalar that a scene asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SceneScalar {
    /// Doubles.
    F64,
    /// Single precision.
    F32,
}

impl SceneScalar {
    /// Every scalar with its word.
    pub const WORDS: [(&'static str, Self); 2] =
        [("f64", SceneScalar::F64), ("f32", SceneScalar::F32)];
}

impl Scene {
    /// The word for the pose of a locked base: gravity is in its axes as in the robot file.
    pub const LEVEL: &'static str = "level";

    /// Returns the position a joint is locked at.
    pub fn locked(&self, joint: usize) -> Option<&Position> {
        let mut locks = self.lock.iter();
        locks.find(|(at, _)| *at == joint).map(|(_, q)| q)
    }

    /// Returns the coordinates of a base that floats in the scene: six, or none.
    pub fn base_coordinates(&self, robot: &Robot) -> usize {
        match self.lock_base {
            true => 0,
            false => robot.base_coordinates(),
        }
    }

    /// Returns the scene without its tolerance.
    #[must_use]
    pub fn without_tolerance(&self) -> Scene {
        Scene {
            tolerance: None,
            ..self.clone()
        }
    }

    /// Returns the joints whose torques are wanted, of a robot of n joints.
    pub fn rows(&self, n: usize) -> Vec<usize> {
        match &self.joints {
            Some(joints) => joints.clone(),
            None => (0..n).filter(|&i| self.locked(i).is_none()).collect(),
        }
    }
}
