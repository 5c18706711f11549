//! Robot files: TOML in, a validated [`Robot`] out, or every error at once.
//!
//! The text passes through, in this order:
//! - `guard`: size, depth and count limits, before anything recursive runs
//! - `toml-span`, for the structure and the spans; its numbers are not used
//! - `file`, `joint`, `mimic`, `link`, `scene`: the keys of the file, through `table` and `value`
//! - [`Robot::validate`] and [`Scene::validate`], whose findings name places of the file, which
//!   `table` finds in it
//!
//! # Keys besides those of rows
//!
//! ```toml
//! base = { xyz = [0, 0, 0.8], rpy = ["pi", 0, 0] }    # frame 0 in base axes
//! tool = { xyz = [0, 0, 0.107] }                      # the hand in the last frame
//! payload_frame = { xyz = [0, 0, 0.05] }              # of payloads in the last frame
//! allow = ["impossible_inertia"]                      # warnings that are known, by name
//! outputs = ["inverse_dynamics", "gravity"]            # generated where a request names none
//! notes = ["without springs"]                         # lines for the head of generated files
//!
//! [[joint]]                       # a joint without a row of the DH table:
//! placement = { xyz = [0.3, 0, 0.1], rpy = [0, "pi/2", 0] }
//! axis = [0, 0, 1]
//!
//! [[joint]]                       # the first one alone: a base that floats
//! kind = "floating"
//! limits = { velocity = [2, 2, 1, 4, 4, 4] }          # of (v, ω) in its axes
//!
//! [[frame]]                       # a frame by its name, fixed to the link of joint 1
//! name = "camera"
//! link = 1
//! xyz = [0, 0.05, 0.1]
//! rpy = ["pi/2", 0, 0]
//! ```
//!
//! An oddity that is not wrong is a warning, with the name that silences it ([`RobotWarning`]).
//!
//! Gravity, poses, Jacobians and wrenches are in base axes, which are frame 0's own without a
//! `base`. A placement is where a frame is in the one before: moved by `xyz` metres, its axes
//! turned by `rpy` about the fixed axes x, y and z, in this order, as in URDF. Joints are placed
//! all or none; their `com` and `inertia`, the `tool` and payloads are in the links' own frames,
//! whose origins lie on the joints' axes. [`placed`](crate::placed) says which rows they get.
//! `link_poses` and the parameters of regressors are those of the links' own frames: a joint with a
//! row may say where that is in the row's, `frame`. Frames by name are in the links' own where
//! joints are placed, and in the rows' otherwise. A row of nearly parallel axes has a `beta`.
//!
//! `report` collects diagnostics; `foreign` finds the likely intention.

mod base;
mod file;
mod foreign;
mod guard;
mod joint;
mod link;
mod mimic;
mod report;
mod scene;
mod syntax;
mod table;
mod value;

use alloc::vec::Vec;

use crate::outputs::Function;
use crate::robot::Robot;
use crate::scene::Scene;

pub use crate::diagnostic::{Diagnostic, Diagnostics, Severity};
pub use crate::robot::RobotWarning;
pub use guard::MAX_BYTES;

/// A robot file that was read.
#[derive(Clone, Debug)]
pub struct Reading {
    /// The robot; [`Robot::validate`] finds no error in it.
    pub robot: Robot,
    /// The functions that the file lists, which are generated where a request names none.
    pub outputs: Vec<Function>,
    /// Its scenes, in the order of the file; [`Scene::validate`] finds nothing.
    pub scenes: Vec<Scene>,
    /// Warnings and notes, in the order of the file.
    pub notes: Vec<Diagnostic>,
}

/// Reads a robot file.
///
/// # Errors
/// All that is wrong with the file, in its order; only an error of the syntax hides those after it.
pub fn parse(source: &str) -> Result<Reading, Diagnostics> {
    let (sink, unread) = (report::Sink::new(source), Vec::new());
    let mut cx = value::Context { sink, unread };
    let read = file::read(source, &mut cx);
    cx.sink.finish(read)
}

/// Reads a robot file from bytes.
///
/// # Errors
/// As [`parse`], and if the bytes are not UTF-8.
pub fn parse_bytes(bytes: &[u8]) -> Result<Reading, Diagnostics> {
    match core::str::from_utf8(bytes) {
        Ok(source) => parse(source),
        Err(error) => Err(report::not_utf8(bytes, error.valid_up_to())),
    }
}
