//! Robot files from URDF and MJCF.
//!
//! [`import`] takes a part of a model, the chain from a base to a tip or all that moves, and writes
//! the robot file that says the same: every joint by its placement.
//!
//! - `open`: a robot of a path, whichever format it has
//! - `text`, `xml`, `include`: the text of a model, as elements that know their places
//! - `problems`: what is wrong or odd, at its place in the text
//! - `keywords`, `read`: which names are read, and words and numbers of attributes
//! - `model`: links and joints as a file says them; `urdf` and `mjcf` read it
//! - `orientation`, `bounds`: orientations in all their forms; masses that MuJoCo's compiler changes
//! - `args`, `arms`: the options that choose a part; every arm of a robot
//! - `select`: the part of a model that is the robot
//! - `snap`, `meant`: numbers that were meant to be others: 1.57079632679 is π/2
//! - `merge`: links that are fixed to each other, as one body of a tree
//! - `change`: the change by snapping, bounded
//! - `write`: the robot file
//!
#![doc = include_str!("reading.md")]
#![forbid(unsafe_code)]
#![warn(missing_docs, clippy::missing_errors_doc)]

mod args;
mod arms;
mod bounds;
mod change;
mod follow;
mod include;
mod keywords;
mod meant;
mod merge;
mod mjcf;
mod model;
mod open;
mod orientation;
mod problems;
mod read;
mod select;
mod snap;
mod text;
mod urdf;
mod write;
mod xml;

use std::fmt::Display;

use dalembert_model::diagnostic::{Diagnostic, Diagnostics};
use dalembert_model::number::Rational;
use dalembert_model::read as robot_file;
use dalembert_model::robot::Robot;

pub use args::ChainArgs;
pub use arms::{SharedJoints, arms};
pub use change::{Change, Displacement, Motion};
use keywords::{MJCF, URDF};
use model::Model;
pub use open::{OpenError, OpenRobot, first_bytes, is_model, open, open_text, read_robot};
use problems::Problems;
use read::Reader;
use select::Selection;
use snap::Reach;
pub use snap::Snap;
pub use text::{MAX_BYTES, Text};

/// The largest change of a torque, relative to its limit, that snapping makes unasked.
pub const FELT: f64 = 1e-6;

/// The part to take of a model, and how.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// The link that stands still, or floats; without one, the root.
    pub base: Option<String>,
    /// The link whose frame is the hand; without one, the palm that the fingers hang on
    /// or the end of the longest chain, if there is one; the first of several that one joint moves.
    /// Several take the joints on the ways to all of them.
    pub tips: Vec<String>,
    /// Take every joint that moves; no tips are given then. A part that a free joint carries floats.
    pub tree: bool,
    /// Let the base float; without tips every joint that moves is taken. A part that a free
    /// joint carries floats unasked if it has several limbs.
    pub floating: bool,
    /// Joints that stay where they are, each with its position, within the joint's
    /// limits: a number of the model's units, `pi/2` or `90deg`. The name `*` stands for
    /// every joint that hangs on the chain: each is held there, or at the nearest limit. A
    /// number that is no joint's name counts, from 1, those that move, from the root outwards.
    pub lock: Vec<(String, String)>,
    /// Links to leave away, with everything that hangs on them.
    pub without: Vec<String>,
    /// Take every digit as it stands. If links branch and more than six angles are odd, these
    /// are within 2⁻⁵² rad.
    pub exact: bool,
    /// Take rounded numbers for the exact ones that they were probably meant to be, however much
    /// that changes the torques; without it, where it changes them by at most [`FELT`] of their
    /// limits.
    pub snap: bool,
    /// Leave out tendons, loops and equalities, which no chain of joints can have.
    pub ignore_ties: bool,
    /// The limit of acceleration of each joint that has none in the model, rad/s² or m/s².
    pub acceleration: Option<Rational>,
    /// The name of the file, for the robot file's first line.
    pub file: String,
    /// The name of the arm; without one, the model's.
    pub name: Option<String>,
}

/// A part of a model as a robot file.
#[derive(Clone, Debug)]
pub struct Import {
    /// The robot file.
    pub text: String,
    /// The robot that it is read as.
    pub robot: Robot,
    /// Warnings and notes, each at its place in the text. Those that [`Robot::notes`] repeats are
    /// first: what the arm has otherwise than the model, so that results differ.
    pub notes: Vec<Diagnostic>,
    /// Every number that was taken for another, in the order of the file.
    pub snaps: Vec<Snap>,
    /// The change that they make; `None` where there is none.
    pub change: Option<Change>,
}

/// Makes a robot file of a part of a model that is one text.
///
/// # Errors
/// Everything that is wrong with the model or the options, at once, each at its
/// place in the text.
pub fn import(source: &str, options: &Options) -> Result<Import, Diagnostics> {
    import_text(&Text::of("", source.to_owned()), options)
}

/// Makes a robot file of a part of a model that may be in several files.
///
/// # Errors
/// Those of [`import`].
pub fn import_text(text: &Text, options: &Options) -> Result<Import, Diagnostics> {
    let mut problems = Problems::of(text);
    let model = read_model(text, options, &mut problems);
    import_model(model.as_ref(), options, problems)
}

fn read_model(text: &Text, options: &Options, problems: &mut Problems) -> Option<Model> {
    let root = text.elements(problems)?;
    let is_mjcf = root.tag == "mujoco";
    let table = if is_mjcf { &MJCF } else { &URDF };
    let mut reader = Reader::new(problems, table);
    let model = match is_mjcf {
        true => mjcf::read(&root, &mut reader),
        false => urdf::read(&root, &mut reader),
    };
    reader.report_unknown();
    let mut model = model?;
    select::check_names(&model, options, problems);
    if options.ignore_ties {
        model.untie(problems);
    }
    (!problems.has_errors()).then_some(model)
}

/// Makes the robot file of a part; the problems are those of reading the model.
fn import_model(
    model: Option<&Model>,
    options: &Options,
    mut problems: Problems,
) -> Result<Import, Diagnostics> {
    let selected =
        model.and_then(|model| Some((model, select::select(model, options, &mut problems)?)));
    let chosen = selected.as_ref();
    let parts = chosen.map(|(model, selection)| selection.parts(model));
    // Where the parts of the robot are unknown, all mistakes count.
    problems.settle(|part| parts.as_ref().is_none_or(|parts| parts.contains(&part)));
    let imported =
        selected.and_then(|(model, selection)| imported(model, &selection, options, &mut problems));
    let notes = problems.finish()?;
    match imported {
        Some(imported) => Ok(Import { notes, ..imported }),
        // Nothing is given up without an error.
        None => Err(Diagnostics(notes)),
    }
}

fn imported(
    model: &Model,
    selection: &Selection,
    options: &Options,
    problems: &mut Problems,
) -> Option<Import> {
    let as_written = merge::merged(model, selection, problems)?;
    if problems.has_errors() {
        return None;
    }
    let text = problems.text;
    let mut reach = match options.exact {
        true => Reach::None,
        false => Reach::All,
    };
    let (model, snaps, tree, change) = loop {
        let (model, snaps) = snap::snapped(model, selection, reach);
        let tree = match snaps.is_empty() {
            true => as_written.clone(),
            // Messages were given for the digits as written; do not repeat them.
            false => merge::merged(&model, selection, &mut Problems::of(text))?,
        };
        let change = change::bound(&as_written, &tree, &model, options);
        let is_felt = !options.snap && change.relative() > FELT;
        reach = match reach {
            Reach::All if is_felt => {
                problems.report("digits_stay", &model.at, &[&change]);
                Reach::Near
            }
            Reach::Near if is_felt => Reach::None,
            _ => break (model, snaps, tree, change),
        };
    };
    let stays = reach != Reach::All;
    let text = write::file(&model, selection, &tree, (&snaps, stays), options, problems);
    let robot = match robot_file::parse(&text) {
        Ok(reading) => reading.robot,
        Err(errors) => {
            for error in &errors.0 {
                let index = error.line().unwrap_or(1).saturating_sub(1);
                let line = text.lines().nth(index).unwrap_or_default();
                let help = error.help.as_deref();
                let words: [&dyn Display; 3] = [&error.message, &line, &help.unwrap_or_default()];
                problems.report("refused", &(0..0), &words);
            }
            return None;
        }
    };
    Some(Import {
        text,
        robot,
        notes: Vec::new(),
        change: (!snaps.is_empty()).then_some(change),
        snaps,
    })
}
