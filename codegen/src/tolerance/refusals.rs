//! The reasons for which a tolerance, or an error of polynomials, cannot be met.

use std::fmt;

use dalembert_checker::Fault;

use super::variant::Variant;
use crate::function::{Argument, Columns, Function};
use crate::program::Program;
use crate::words::{Complaint, complaint};

/// The reasons for which no variant meets a tolerance.
#[derive(Clone, Debug, PartialEq)]
pub enum ToleranceError {
    /// Errors of such a function have no bound, a limit that it needs is missing, or the actuators
    /// are no measure of its outputs; or it would take more work than may be done.
    Refused(Complaint),
    /// The full model's D cannot be shown to be positive definite.
    Indefinite(Complaint),
    /// A value inside the box may be more than the scalar holds.
    Overflow(Complaint),
    /// Already what sines and rounding cost cannot be shown to be less.
    Above(Complaint),
}

pub(crate) const FRICTION: &str = "it has Coulomb friction in it, which divides by a root, so its \
    errors have no certified bound: leave `coulomb` out of the robot file and add the friction to \
    the torques yourself, or leave the tolerance out of the scene";

pub(crate) const FOLLOWS: &str = "joints of the robot follow others (`mimic`), and what may be \
    left out of links that share a coordinate is not bounded: leave the tolerance out of the scene";

pub(crate) fn unbounded(function: Function, floats: bool) -> Option<Complaint> {
    if function.columns() != Columns::None {
        let why = "its entries multiply parameters of any size";
        return Some(no_bound(why));
    }
    if function.inverts_inertia() {
        return Some(no_bound(DIVIDES));
    }
    let mut arguments = function.arguments().into_iter();
    let other = arguments.find(|argument| !is_bounded(*argument, floats));
    other.map(reads)
}

pub(super) fn unbounded_by(program: &Program) -> Option<Complaint> {
    if program.divides() {
        return Some(no_bound(DIVIDES));
    }
    let rubs = !program.speeds.is_empty();
    let friction = rubs.then(|| complaint(FRICTION));
    friction.or_else(|| unbounded(program.function, program.floating > 0))
}

/// Returns true for an argument that a box has ranges for: gravity has a length where the base floats.
pub(crate) fn is_bounded(argument: Argument, floats: bool) -> bool {
    let is_gravity = argument == Argument::Gravity && floats;
    Argument::STATE.contains(&argument) || argument == Argument::Load || is_gravity
}

pub(crate) fn reads(argument: Argument) -> Complaint {
    let why = format!(
        "a tolerance needs ranges, and a box has none for `{}`",
        argument.name()
    );
    match argument {
        Argument::Gravity => complaint(format!(
            "{why}: leave `gravity` out of the parameters, or give its value in the scene"
        )),
        _ => no_bound(&why),
    }
}

/// Returns the reason why a variant is not shown, by the checker's words.
pub(super) fn above(variant: &Variant, fault: &Fault) -> Complaint {
    let why = match fault {
        Fault::Claim(why) => why.clone(),
        fault => fault.to_string(),
    };
    let name = format!("`{}`: ", variant.emitted.function.name());
    let why = why.strip_prefix(&name).unwrap_or(&why);
    let wider = variant.scalar.of("", ", or choose a wider scalar");
    let help = match why.contains("has a bound of") {
        true => format!("; allow more{wider}"),
        false => String::new(),
    };
    complaint(format!(
        "no variant in {} is shown to be within the tolerance: with nothing left out, {why}{help}",
        variant.scalar
    ))
}

const DIVIDES: &str = "it divides by what depends on the state";

fn no_bound(why: &str) -> Complaint {
    complaint(format!(
        "{why}, so its errors have no certified bound: give the tolerance to `inverse_dynamics`, or \
         to `manipulator_equation` for D, h and c"
    ))
}

impl fmt::Display for ToleranceError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ToleranceError::Refused(why)
            | ToleranceError::Indefinite(why)
            | ToleranceError::Overflow(why)
            | ToleranceError::Above(why) => why.fmt(f),
        }
    }
}

impl std::error::Error for ToleranceError {}
