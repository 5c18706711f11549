//! The reasons for which a tolerance, or an error of polynomials, cannot be met.

use dalembert_checker::Fault;
use dalembert_model::diagnostic::Diagnostic;

use super::variant::Variant;
use crate::function::{Argument, Function, RegressorColumns};
use crate::program::Program;

pub(crate) const FRICTION_IS_UNBOUNDED: &str = "it has Coulomb friction in it, which divides by a root, so its \
    errors have no certified bound: leave `coulomb` out of the robot file and add the friction to \
    the torques yourself, or leave the tolerance out of the scene";

pub(crate) const FOLLOWERS_ARE_UNBOUNDED: &str = "joints of the robot follow others (`mimic`), and what may be \
    left out of links that share a coordinate is not bounded: leave the tolerance out of the scene";

pub(crate) fn unbounded(function: Function, floats: bool) -> Option<Diagnostic> {
    if function.columns() != RegressorColumns::None {
        return Some(no_bound("its entries multiply parameters of any size"));
    }
    if function.inverts_inertia() {
        return Some(no_bound(DIVIDES));
    }
    let mut arguments = function.arguments().into_iter();
    let other = arguments.find(|argument| !is_bounded(*argument, floats));
    other.map(without_range)
}

pub(super) fn unbounded_by(program: &Program) -> Option<Diagnostic> {
    if program.divides() {
        return Some(no_bound(DIVIDES));
    }
    if !program.speeds.is_empty() {
        return Some(Diagnostic::error(FRICTION_IS_UNBOUNDED));
    }
    unbounded(program.function, program.floating > 0)
}

/// Returns true for an argument that a box has ranges for: gravity has a length where the base floats.
pub(crate) fn is_bounded(argument: Argument, floats: bool) -> bool {
    let is_gravity = argument == Argument::Gravity && floats;
    Argument::STATE.contains(&argument) || argument == Argument::Load || is_gravity
}

pub(crate) fn without_range(argument: Argument) -> Diagnostic {
    let name = argument.name();
    let why = format!("a tolerance needs ranges, and a box has none for `{name}`");
    match argument {
        Argument::Gravity => Diagnostic::error(format!(
            "{why}: leave `gravity` out of the parameters, or give its value in the scene"
        )),
        _ => no_bound(&why),
    }
}

/// Returns the reason why a variant is not shown, by the checker's words.
pub(super) fn not_shown(variant: &Variant, fault: &Fault) -> Diagnostic {
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
    Diagnostic::error(format!(
        "no variant in {} is shown to be within the tolerance: with nothing left out, {why}{help}",
        variant.scalar
    ))
}

const DIVIDES: &str = "it divides by a value that depends on the state";

fn no_bound(why: &str) -> Diagnostic {
    Diagnostic::error(format!(
        "{why}, so its errors have no certified bound: give the tolerance to `inverse_dynamics`, or \
         to `manipulator_equation` for D, h and c"
    ))
}
