//! Constants out of a scalar's range, and overflow inside the robot's limits.

use dalembert_model::diagnostic::Diagnostic;
use dalembert_model::number::{Exact, Rounded};
use dalembert_model::robot::Robot;
use dalembert_model::scalar::Scalar;
use dalembert_model::scalar::field::{Field, ProofField};

use super::{GeneratedFunction, Request};
use crate::dag::{Node, Points};
use crate::function::Argument;
use crate::program::{Program, ScalarType};
use crate::setup::Setup;
use crate::tolerance::input_box::InputBox;
use crate::tolerance::overflow::overflows;

pub(super) fn vanishing(setup: &Setup) -> Option<Exact> {
    let mut lost = None;
    let mut constant = |value: &Exact| {
        if Points::lose::<{ Field::P }>(value) || Points::lose::<{ ProofField::P }>(value) {
            lost.get_or_insert_with(|| value.clone());
        }
        value.clone()
    };
    setup.arm(&mut constant);
    setup.motion(|_| Exact::zero(), constant);
    lost
}

pub(super) fn leave_out_single(
    request: &Request,
    functions: &[GeneratedFunction],
    scalars: &mut Vec<ScalarType>,
) -> Option<String> {
    if !request.is_scalar_open || scalars.len() < 2 {
        return None;
    }
    let mut functions = functions.iter();
    let why =
        functions.find_map(|function| check_constants(&function.program, ScalarType::F32).err())?;
    scalars.retain(|scalar| *scalar == ScalarType::F64);
    Some(why.message + ": only f64 is generated; choose other units for both")
}

/// The relative rounding errors of subnormal constants are not bounded by u.
pub(super) fn check_constants(
    program: &Program,
    scalar: ScalarType,
) -> Result<Vec<String>, Diagnostic> {
    let (function, mut warnings) = (program.function, Vec::new());
    for node in &program.dag.nodes {
        let Node::Constant(constant) = node else {
            continue;
        };
        let rounded = scalar.round(constant);
        // A sum over constant angles may be zero by a relation between them
        // that is not known as such; zero is then what it is rounded to.
        if constant.as_rational().is_none() && f64::nearest(constant) == 0.0 {
            continue;
        }
        if !rounded.is_finite() || (rounded == 0.0 && !constant.is_zero()) {
            let value = f64::nearest(constant);
            let message =
                format!("`{function}` needs the constant {value:e}, which {scalar} cannot hold");
            let help = scalar.of("choose other units", "choose other units or a wider scalar");
            return Err(Diagnostic::error(message).with_help(help));
        }
        if rounded != 0.0 && rounded.abs() < scalar.least_normal() {
            warnings.push(format!(
                "`{function}`: the constant {rounded:e} is subnormal in {scalar}"
            ));
        }
    }
    Ok(warnings)
}

pub(super) fn overflow(robot: &Robot, program: &Program, scalar: ScalarType) -> Option<String> {
    // No box says how close to zero a divisor comes, or what is wished for.
    let is_bounded = |argument| Argument::STATE.contains(argument);
    if program.divides() || !program.arguments.iter().all(is_bounded) {
        return None;
    }
    let warnings = overflows(program, scalar, &InputBox::of(robot).ok()?);
    let (first, others) = warnings.split_first()?;
    let (function, more) = (program.function, others.len());
    Some(format!(
        "`{function}` in {scalar}, inside the robot's limits: {first}; {more} more like it"
    ))
}
