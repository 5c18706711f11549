//! Robot files from URDF and MJCF.
//!
//! [`import`] takes one chain of a URDF, from a base to a tip, and writes the robot
//! file that says the same: every joint by its placement, as the URDF has it. An MJCF,
//! MuJoCo's format, is read as the URDF that says the same; both are called URDF here.
//!
//! - `text`: a model's text, and where in its files a place is; `include`: what an MJCF includes
//! - `guard`: XML within limits
//! - `urdf`: what a URDF says, each number with its digits and its place
//! - `mjcf`: what an MJCF says, in the terms of a URDF
//! - `problems`: what is wrong or odd, at its place in the file
//! - `open`: a robot of a path, whichever format it has
//! - `args`: the options of a chain, as commands take them and generated files keep them, and names
//!   in them that the file does not have
//! - `tree`: the chain, and what hangs on its links
//! - `beside`: what hangs beside the chain, or is tied to it
//! - `tip`: where an arm ends, when nobody says
//! - `arms`: every arm of a robot
//! - `meant`: the angle that digits were meant to be
//! - `lock`: joints that stay where they are
//! - `snap`: numbers that were meant to be others: 1.57079632679 is π/2
//! - `merge`: links that are fixed to each other, as one body
//! - `change`: what snapping changes, bounded
//! - `write`: the robot file
//!
//! # What is read
//!
//! Joints that are revolute, continuous, prismatic or fixed, their limits (a limit
//! of zero is none), damping as viscous friction, and rotors where a transmission's
//! actuator has an inertia and a reduction. A continuous joint has no limits of
//! position. Coulomb friction is said, with the
//! lines that bring it, and left out: a URDF has no width to smooth it over. Links that are fixed to each
//! other become one; what hangs on a link moves with it. A movable joint beside the
//! chain must be [locked](Options::lock) or [left away](Options::without), unless it
//! hangs on the base, which feels nothing of it. One that mimics another is
//! held where that is, and follows it in the chain, where both are one coordinate. Planar and floating joints are
//! refused where they would move.
//!
//! Every link that moves is a frame of the robot file by its name, so outputs can be had
//! at any of them (`jacobian@tool0`). A name that cannot be a function's is written in small
//! letters, digits and `_`, with the link's own in a comment.
//!
//! Gravity is 9.81 m/s² against the z axis of the base's link: a URDF does not say.
//!
//! Of an MJCF: bodies with their joints, hinges and slides, several to a body, frames and
//! sites, defaults and their classes, every way to write an orientation, units and orders
//! of angles, inertials, and the mass of simple geoms where MuJoCo takes that; gravity;
//! armature and damping; forces of actuators as limits of torque; `settotalmass`. Springs, friction and
//! gravity compensation are said and left out. Equalities, tendons and loops are refused
//! where they would move, unless they are [left out](Options::ignore_ties), and so is a mass that only a
//! mesh knows. A fixed tendon over one joint is a limit of that.
//!
//! # Digits
//!
//! A URDF has 1.57079632679 for π/2 and 7.7e-34 for 0; taken at their word every
//! structural zero is lost, and with it most of what generated code saves. [`Snap`]
//! is a number that was taken for another, under these rules:
//!
//! - an angle within 1e-9 rad of a multiple of π/2, or within one unit of its last
//!   digit, at most 1e-5 rad: `1.5708` is π/2, `1.57` stays;
//! - the same of multiples of π/4 and π/6, within 1e-12 rad, or one unit of the last
//!   of at least five digits;
//! - an angle that is less than another of its `rpy` is off from what that was taken for: 0;
//! - a length, or a coordinate of a centre of mass, below 1e-9 m: 0;
//! - a component of an axis within 1e-9 of 0, 1 or −1;
//! - a product of inertia below 1e-9 of the largest moment: 0;
//! - an orientation by a quaternion of five digits, or by axes: each of its angles within
//!   1e-5 rad of a multiple of π/2, π/4 or π/6, as many quaternions come from 1.5708.
//!
//! What all of them together change in the torques and in where the hand is, is
//! bounded ([`Change`]). Where that is more than [`FELT`] of the torques' limits, only numbers within 1e-9
//! of exact ones are taken for these, unless [`Options::snap`] asks for all.
//! [`Options::exact`] takes the digits as they stand; the reader of robot files still
//! takes the double next to a multiple of π/2 for it.
#![forbid(unsafe_code)]
#![warn(missing_docs, clippy::missing_errors_doc)]

mod args;
mod arms;
mod beside;
mod change;
mod guard;
mod include;
mod lock;
mod meant;
mod merge;
mod mjcf;
mod open;
mod problems;
mod snap;
mod text;
mod tip;
mod tree;
mod urdf;
mod write;

use dalembert_model::number::Rational;
use dalembert_model::read::{self, Diagnostic, Diagnostics};
use dalembert_model::robot::Robot;

pub use args::ChainArgs;
pub use arms::{Shared, arms};
pub use change::{Change, Displacement, Motion};
pub use open::{Opened, Unopened, first_bytes, is_model, open, open_text, read_robot};
use problems::Problems;
pub use snap::Snap;
use snap::Snapping;
pub use text::Text;

/// The largest URDF that is read, in bytes: meshes are not in it.
pub const MAX_BYTES: usize = 1 << 24;

const MAX_MIB: usize = MAX_BYTES >> 20;

/// The largest change of a torque, relative to its limit, that snapping makes unasked.
pub const FELT: f64 = 1e-6;

/// The chain to take of a URDF, and how.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// The link that stands still; without one, the root.
    pub base: Option<String>,
    /// The link whose frame is the hand; without one, the palm that the fingers hang on
    /// or the end of the longest chain, if there is one; the first of several that one joint moves.
    pub tip: Option<String>,
    /// Joints that stay where they are, each with its position, within the joint's
    /// limits: a number of the URDF's units, `pi/2` or `90deg`. The name `*` stands for
    /// every joint that hangs on the chain: each is held there, or at the nearest limit. A
    /// number that is no joint's name counts, from 1, those that move, from the root outwards.
    pub lock: Vec<(String, String)>,
    /// Links to leave away, with everything that hangs on them.
    pub without: Vec<String>,
    /// Take every digit as it stands.
    pub exact: bool,
    /// Take rounded numbers for the exact ones that they were probably meant to be, however much
    /// that changes the torques; without it, where it changes them by at most [`FELT`] of their
    /// limits.
    pub snap: bool,
    /// Leave out tendons, loops and equalities, which no chain of joints can have.
    pub ignore_ties: bool,
    /// The limit of acceleration of every joint, rad/s² or m/s²: no model has one.
    pub acceleration: Option<Rational>,
    /// The name of the file, for the robot file's first line.
    pub file: String,
    /// The name of the arm; without one, the model's.
    pub name: Option<String>,
}

/// A chain of a URDF.
#[derive(Clone, Debug)]
pub struct Imported {
    /// The robot file.
    pub text: String,
    /// The robot that it is read as.
    pub robot: Robot,
    /// Warnings and notes, each at its place in the URDF. Those that [`Robot::notes`] repeats are
    /// first: what the arm has otherwise than the model, so that results differ.
    pub notes: Vec<Diagnostic>,
    /// Every number that was taken for another, in the order of the file.
    pub snaps: Vec<Snap>,
    /// The change that they make; `None` where there is none.
    pub change: Option<Change>,
}

/// Makes a robot file of a chain of a URDF, or of an MJCF that is one text.
///
/// # Errors
/// Everything that is wrong with the URDF or the options, at once, each at its
/// place in the URDF.
pub fn import(source: &str, options: &Options) -> Result<Imported, Diagnostics> {
    import_text(&Text::of("", source.to_owned()), options)
}

/// Makes a robot file of a chain of a model that may be in several files.
///
/// # Errors
/// Those of [`import`]; [`Text::render`] says in which file they are.
pub fn import_text(text: &Text, options: &Options) -> Result<Imported, Diagnostics> {
    let mut problems = Problems::of(text);
    let imported = imported(text.as_str(), options, &mut problems);
    let notes = problems.finish()?;
    match imported {
        Some(imported) => Ok(Imported { notes, ..imported }),
        // Nothing is given up without an error.
        None => Err(Diagnostics(notes)),
    }
}

fn model(source: &str, options: &Options, problems: &mut Problems) -> Option<urdf::Urdf> {
    let document = guard::parse(source, problems)?;
    let mut urdf = match document.root_element().has_tag_name("mujoco") {
        true => mjcf::read(&document, problems)?,
        false => urdf::read(&document, problems)?,
    };
    args::check_names(&urdf, options, problems);
    if options.ignore_ties {
        urdf.untie(problems);
    }
    // What the rest lacks would be what could not be read.
    (!problems.has_errors()).then_some(urdf)
}

fn imported(source: &str, options: &Options, problems: &mut Problems) -> Option<Imported> {
    let urdf = model(source, options, problems)?;
    let chain = tree::chain(&urdf, options, problems)?;
    let as_written = merge::arm(&urdf, &chain, problems)?;
    let snapped = |snapping: Snapping| {
        let (snapped, snaps) = snap::snapped(&urdf, &chain, snapping);
        // What there is to say was said of the digits as they stand.
        let arm = merge::arm(&snapped, &chain, &mut Problems::new(source))?;
        let change = change::bound(&as_written, &arm, &snapped, &chain, options);
        Some((snapped, snaps, arm, change))
    };
    let mut stays = options.exact;
    let mut taken = snapped(if stays { Snapping::None } else { Snapping::All })?;
    if !options.snap && taken.3.relative() > FELT {
        let message = format!(
            "rounded numbers stay as they are: the exact ones that were probably meant would change \
             the torques by {}",
            taken.3
        );
        let help = "--snap takes the exact ones, and code gets shorter";
        problems.note(&urdf.span, message, help);
        stays = true;
        taken = snapped(Snapping::Near)?;
        if taken.3.relative() > FELT {
            taken = snapped(Snapping::None)?;
        }
    }
    let (snapped, snaps, arm, change) = taken;
    let text = write::file(&snapped, &chain, &arm, (&snaps, stays), options, problems);
    let reading = read::parse(&text).map_err(|errors| problems.refused(&errors, &text));
    let robot = reading.ok()?.robot;
    let change = (!snaps.is_empty()).then_some(change);
    Some(Imported {
        text,
        robot,
        notes: Vec::new(),
        snaps,
        change,
    })
}
