//! A robot with exact parameters: a serial arm, or a tree of links, whose base may float.
//!
//! One [`Joint`] per row of the DH table, or per joint that is placed where links branch;
//! everything is SI, angles are exact ([`Angle`]), all other numbers are exact rationals.
//!
//! - `findings`: errors and warnings, each at a place of the robot file ([`Diagnostic`](crate::diagnostic::Diagnostic)), and the
//!   names by which a file silences them ([`RobotWarning`])
//! - `follower`: joints that follow others, rows without a coordinate ([`Follower`])
//! - `floating`: a base that floats ([`FloatingBase`])
//! - `tree`: which link carries which ([`Parent`])
//! - `validate`: checks of robots, from files and from code ([`Robot::validate`])
//! - `reach`: how far an arm reaches, and inertias too large for that
//! - `units`: sizes that were probably meant in another unit
//! - `body`: which inertia tensors a body can have
//! - [`values`]: numbers, angles and placements as robot files have them
//! - `write`: the robot file that says the same ([`write`](write())), and its hash

mod body;
mod findings;
mod floating;
mod follower;
pub(crate) mod reach;
mod tree;
mod units;
mod validate;
pub mod values;
mod write;

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use core::fmt;

use num_traits::{Signed, Zero};

use crate::number::{Angle, Rational};

pub use crate::diagnostic::RobotWarning;
pub use body::Defect;
pub(crate) use findings::Findings;
pub use floating::{BaseLimits, FloatingBase};
pub use follower::Follower;
pub(crate) use tree::limb_starts;
pub use tree::{Parent, Placed};

pub(crate) use units::shown;
pub(crate) use validate::{ENDINGS, WORDS, is_plain, is_snake};
pub use validate::{HAND, is_frame_name, suggested_name};
pub use write::{write, write_frame};

/// The DH convention of the table.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Convention {
    /// A_i = Rz(θ_i) Tz(d_i) Tx(a_i) Rx(α_i): joint i acts along z_{i−1} (eq. 2.1).
    #[default]
    Standard,
    /// A_i = Rx(α_i) Tx(a_i) Rz(θ_i) Tz(d_i): joint i acts along z_i (Craig).
    Modified,
}

impl Convention {
    /// Every convention with the word that robot files use for it.
    pub const WORDS: [(&'static str, Self); 2] = [
        ("standard", Convention::Standard),
        ("modified", Convention::Modified),
    ];
}

/// The kind of motion of a joint.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum JointKind {
    /// Turns about its axis: θ_i = q_i + constant.
    #[default]
    Revolute,
    /// Slides along its axis: d_i = q_i + constant.
    Prismatic,
}

impl JointKind {
    /// Every kind with the word that robot files use for it.
    pub const WORDS: [(&'static str, Self); 2] = [
        ("revolute", JointKind::Revolute),
        ("prismatic", JointKind::Prismatic),
    ];
}

/// A serial arm, or a tree of links, whose base may float: a row for each joint and the link that it
/// moves. Numbers are exact, in SI units. A robot file becomes one by `read::parse`;
/// [`Robot::validate`] says what is wrong with one that is made in code.
///
/// ```
/// use dalembert_model::number::Rational;
/// use dalembert_model::read::parse;
///
/// let text = "
///     name = \"slide\"
///     convention = \"standard\"
///     gravity = [0, 0, -9.81]
///     [[joint]]
///     kind = \"prismatic\"
///     mass = 2.5
///     com = [0, 0, 0]
///     inertia = [0.1, 0.1, 0.1, 0, 0, 0]
/// ";
/// let robot = parse(text)?.robot;
/// assert_eq!(robot.joints[0].mass, Rational::new(5.into(), 2.into()));
/// assert!(robot.validate().is_empty());
/// # Ok::<(), dalembert_model::read::Diagnostics>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Robot {
    /// Its name; the generated module is called after it.
    pub name: String,
    /// DH convention of every row.
    pub convention: Convention,
    /// Acceleration of gravity in base axes, m/s², e.g. (0, 0, −9.81); of a base that floats in the
    /// world's, and functions take it in the base's.
    ///
    /// Base axes are those that [`Robot::base`] places frame 0 in, here and in
    /// every pose, Jacobian and wrench; without it they are frame 0's own.
    pub gravity: [Rational; 3],
    /// Frame 0 of the DH table in base axes, unless they are the same.
    pub base: Option<Placement>,
    /// The hand in the last frame, unless it is that: what poses and Jacobians are of.
    pub tool: Option<Placement>,
    /// The frame that payloads are given in, those of scenes and those at run time, in the last
    /// frame, unless it is that frame. For an arm by placements it is the last link's own.
    pub payload_frame: Option<Placement>,
    /// The payloads that there may be, where a payload is an argument.
    pub payload_range: Option<BodyRange>,
    /// The base, if it floats; joints are counted without it.
    pub floating: Option<FloatingBase>,
    /// The joints, each after the one that carries it; 1 to [`Robot::MAX_JOINTS`]. Each is a row of
    /// the table and a coordinate; rows between them may be followers.
    pub joints: Vec<Joint>,
    /// Rows of the table whose joints follow others, in their order.
    pub followers: Vec<Follower>,
    /// Frames that are fixed to links, by their names; at most [`Robot::MAX_FRAMES`].
    pub frames: Vec<Frame>,
    /// Lines for the head of generated files, such as the differences from the model that it was
    /// imported from. They are no parameters, and have no part in its [hash](Robot::input_hash).
    pub notes: Vec<String>,
}

/// A pose of a frame in another: its origin at `xyz`, its axes turned by `rpy`.
///
/// The angles are those of URDF: about the fixed axes x, y and z of the other
/// frame, in this order, so that R = Rz(yaw) Ry(pitch) Rx(roll).
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct Placement {
    /// The origin, m.
    pub xyz: [Rational; 3],
    /// Roll, pitch and yaw.
    pub rpy: [Angle; 3],
}

impl Placement {
    /// Returns true if it moves nothing.
    pub fn is_identity(&self) -> bool {
        self.xyz.iter().all(Zero::is_zero) && self.rpy.iter().all(Angle::is_zero)
    }

    /// Returns |x| + |y| + |z|, in metres: the scale of errors of lengths that are computed from it.
    pub fn size(&self) -> Rational {
        self.xyz.iter().map(Signed::abs).sum()
    }

    /// Returns the placement, unless it moves nothing.
    pub fn unless_identity(self) -> Option<Self> {
        (!self.is_identity()).then_some(self)
    }
}

/// A frame that is fixed to a link.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Frame {
    /// Its name: small letters, digits and single `_`, since functions are called after it.
    pub name: String,
    /// The row of the joint that moves the link, zero-based; `None` for a base that floats.
    pub row: Option<usize>,
    /// Its pose in the frame of that row.
    pub placement: Placement,
}

impl Robot {
    /// Returns the placements that it may have, each with its key in the robot file.
    pub fn placements(&self) -> [(&'static str, Option<&Placement>); 3] {
        [
            ("base", self.base.as_ref()),
            ("tool", self.tool.as_ref()),
            ("payload_frame", self.payload_frame.as_ref()),
        ]
    }

    /// The most joints a robot may have.
    pub const MAX_JOINTS: usize = 64;
    /// The most frames it may have.
    pub const MAX_FRAMES: usize = 1024;
    /// The longest name of a robot or a joint, in characters.
    pub const MAX_NAME: usize = 64;

    /// Returns true if a link has mass or inertia, or a joint an armature.
    pub fn has_mass(&self) -> bool {
        self.bodies().any(|joint| {
            let inertia = joint.inertia.entries();
            let mut numbers = [&joint.mass, &joint.armature].into_iter().chain(inertia);
            numbers.any(|number| !number.is_zero())
        })
    }

    /// Returns a joint's name in messages, from its zero-based index: `joint 2`, `joint 2 (elbow)`.
    pub fn joint_label(&self, index: usize) -> String {
        let name = self.joints.get(index).and_then(|joint| joint.name.as_ref());
        match name {
            Some(name) => format!("joint {} ({name})", index + 1),
            None => format!("joint {}", index + 1),
        }
    }
}

/// The bodies that a payload, or the body of a link, may be where it is an argument.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BodyRange {
    /// The lowest and the highest mass, kg.
    pub mass: [Rational; 2],
    /// All of the mass is so near to the origin of its frame, m.
    pub radius: Rational,
}

impl BodyRange {
    const MOST: i64 = 1_000_000_000;

    /// Returns an error about it, and help, if it is not a range.
    fn error(&self) -> Option<(&'static str, &'static str)> {
        let [low, high] = &self.mass;
        if low.is_negative() || low > high {
            let help = "write mass = [lowest, highest], kg, neither below 0";
            return Some(("the range of its mass is empty or negative", help));
        }
        let most = Rational::from_integer(BodyRange::MOST.into());
        if self.radius.is_negative() || self.radius > most || *high > most {
            let help =
                "the distance within which all of it is, m; neither that nor a mass is above 1e9";
            return Some(("its radius is negative, or a number is too large", help));
        }
        None
    }
}

/// One joint and the link that it moves.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Joint {
    /// Name, if the file gives one.
    pub name: Option<String>,
    /// The link that carries it, unless that is the link before, or the base's for the first.
    pub parent: Option<Parent>,
    /// Revolute or prismatic.
    pub kind: JointKind,
    /// The placement on the link that carries it, with an axis of length one: of every joint of a
    /// robot whose links branch, and then its row is zero; of no other.
    pub place: Option<Placed>,
    /// Twist α_i.
    pub alpha: Angle,
    /// A turn β_i about y after the twist, A_i Ry(β_i), of standard DH: where the next axis is
    /// *nearly* parallel, and the common normal far away, the frame stays near by it (Hayati's).
    pub beta: Angle,
    /// Length a_i, m.
    pub a: Rational,
    /// Constant part of d_i, m: all of it for a revolute joint, for a prismatic one the offset.
    pub d: Rational,
    /// Constant part of θ_i: the offset added to q_i of a revolute joint, all of a prismatic one's.
    pub theta: Angle,
    /// Mass of the link, kg.
    pub mass: Rational,
    /// Centre of mass in the link frame, m.
    pub com: [Rational; 3],
    /// Inertia tensor about the centre of mass in link axes, kg·m².
    pub inertia: Inertia<Rational>,
    /// Viscous damping b_i, N·m·s/rad or N·s/m.
    pub viscous: Rational,
    /// Coulomb friction F_i, N·m or N.
    pub coulomb: Rational,
    /// The speed w_i over which its sign is smoothed, rad/s or m/s; above zero where F_i is.
    pub coulomb_width: Rational,
    /// Rotor inertia felt at the joint, added to D_ii, kg·m² or kg.
    pub armature: Rational,
    /// The link's own frame in its row's, if another: poses are its; com and inertia are the row's.
    pub frame: Option<Placement>,
    /// Limits of motion and load, each optional.
    pub limits: Limits,
}

impl Joint {
    /// True if it has Coulomb friction.
    pub fn has_coulomb(&self) -> bool {
        !self.coulomb.is_zero()
    }
}

/// A symmetric tensor; off-diagonals are the tensor's entries as they stand.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct Inertia<S> {
    /// Row 1, column 1.
    pub xx: S,
    /// Row 2, column 2.
    pub yy: S,
    /// Row 3, column 3.
    pub zz: S,
    /// Row 1, column 2.
    pub xy: S,
    /// Row 2, column 3.
    pub yz: S,
    /// Row 1, column 3.
    pub xz: S,
}

impl<S> Inertia<S> {
    /// Makes a tensor from its entries xx, yy, zz, xy, yz and xz.
    pub fn of([xx, yy, zz, xy, yz, xz]: [S; 6]) -> Self {
        Inertia {
            xx,
            yy,
            zz,
            xy,
            yz,
            xz,
        }
    }

    /// Returns its entries xx, yy, zz, xy, yz and xz.
    pub fn entries(&self) -> [&S; 6] {
        [&self.xx, &self.yy, &self.zz, &self.xy, &self.yz, &self.xz]
    }

    /// Makes a tensor from the entries of row i and column k, zero-based, with i ≤ k.
    pub fn symmetric(entry: impl Fn(usize, usize) -> S) -> Self {
        let places = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)];
        Inertia::of(places.map(|(i, k)| entry(i, k)))
    }

    /// Returns every entry through `f`.
    pub fn map<T>(&self, f: impl FnMut(&S) -> T) -> Inertia<T> {
        Inertia::of(self.entries().map(f))
    }
}

impl<S: Clone> Inertia<S> {
    /// Returns the tensor as three rows of three.
    pub fn rows(&self) -> [[S; 3]; 3] {
        let [xx, yy, zz, xy, yz, xz] = self.entries().map(Clone::clone);
        [
            [xx, xy.clone(), xz.clone()],
            [xy, yy, yz.clone()],
            [xz, yz, zz],
        ]
    }
}

/// Limits of a joint, each optional.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct Limits {
    /// Lowest and highest position.
    pub position: Option<[Position; 2]>,
    /// Largest |q̇|, rad/s or m/s.
    pub velocity: Option<Rational>,
    /// Largest |q̈|, rad/s² or m/s².
    pub acceleration: Option<Rational>,
    /// Largest |τ|, N·m or N.
    pub torque: Option<Rational>,
    /// The bodies of the link, where they are an argument.
    pub body: Option<BodyRange>,
}

impl Limits {
    /// Returns a limit but that of positions.
    pub fn rate(&self, rate: Limit) -> Option<&Rational> {
        match rate {
            Limit::Position => None,
            Limit::Velocity => self.velocity.as_ref(),
            Limit::Acceleration => self.acceleration.as_ref(),
            Limit::Torque => self.torque.as_ref(),
        }
    }
}

/// A limit of a joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Limit {
    /// The range of positions.
    Position,
    /// The largest |q̇|.
    Velocity,
    /// The largest |q̈|.
    Acceleration,
    /// The largest |τ|.
    Torque,
}

impl Limit {
    /// Returns its key in the robot file.
    pub fn key(self) -> &'static str {
        match self {
            Limit::Position => "position",
            Limit::Velocity => "velocity",
            Limit::Acceleration => "acceleration",
            Limit::Torque => "torque",
        }
    }
}

/// A position of a joint.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Position {
    /// The position of a revolute joint.
    Angle(Angle),
    /// The position of a prismatic joint, m.
    Length(Rational),
}

impl Position {
    pub(crate) fn is_of(&self, kind: JointKind) -> bool {
        matches!(self, Position::Angle(_)) == (kind == JointKind::Revolute)
    }

    pub(crate) fn is_below(&self, other: &Self) -> bool {
        match (self, other) {
            (Position::Angle(a), Position::Angle(b)) => a.cmp_value(b).is_lt(),
            (Position::Length(a), Position::Length(b)) => a < b,
            _ => false,
        }
    }
}

impl fmt::Display for Position {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Position::Angle(angle) => angle.fmt(f),
            Position::Length(length) => f.write_str(&shown(length)),
        }
    }
}
