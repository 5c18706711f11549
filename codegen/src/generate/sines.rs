//! Polynomials in place of sines, where they are asked for and no tolerance says how exact they are.

use dalembert_model::diagnostic::Diagnostic;

use super::{GenerateError, GeneratedFunction, Job};
use crate::figures::bound_of;
use crate::function::Function;
use crate::program::{ScalarType, has_inertia};
use crate::setup::Setup;
use crate::sincos::reach::OutOfReach;
use crate::sincos::{self, AngleKernel, SinCos, Sines};
use crate::tolerance::definite::is_definite;
use crate::tolerance::reference::domain;

/// In each scalar all err by no more than [`SinCos::ERROR`], or else by no more than the least
/// error of two digits that can be had. An error that was asked for is kept to.
pub(super) fn give(
    job: &Job<'_>,
    functions: &mut [GeneratedFunction],
    scalars: &[ScalarType],
) -> Result<(), GenerateError> {
    let request = job.request;
    if request.sincos != SinCos::Polynomial || job.tolerance().is_some() {
        return Ok(());
    }
    let wanted = request.sincos_error.unwrap_or(SinCos::ERROR);
    let (mut chosen, mut missed) = (Vec::new(), Vec::new());
    for &scalar in scalars {
        let mut error = wanted;
        let sines = loop {
            match polynomials(job.setup, functions, scalar, error) {
                Ok(sines) => break sines,
                Err((function, mut miss)) => {
                    miss.wanted = wanted;
                    error = miss.reachable().ok_or_else(|| refused(function, &miss))?;
                    missed.push((function, miss));
                }
            }
        };
        chosen.push((scalar, sines));
    }
    // With the error of the worst of them all can be had.
    missed.sort_by(|(_, a), (_, b)| a.least.total_cmp(&b.least));
    if let (Some(_), Some((function, miss))) = (request.sincos_error, missed.last()) {
        return Err(refused(*function, miss));
    }
    for (scalar, lists) in chosen {
        for (generated, sines) in functions.iter_mut().zip(lists) {
            check_inertia(job.setup, generated, scalar, &sines)?;
            generated.sines.push((scalar, sines));
        }
    }
    Ok(())
}

fn polynomials(
    setup: &Setup,
    functions: &[GeneratedFunction],
    scalar: ScalarType,
    error: f64,
) -> Result<Vec<Sines>, (Function, OutOfReach)> {
    let positions = sincos::positions(setup.robot(), scalar);
    let sines = |function: &GeneratedFunction| {
        let sines = sincos::polynomials(&function.program, scalar, &positions, error);
        sines.map_err(|miss| (function.function, miss))
    };
    functions.iter().map(sines).collect()
}

fn refused(function: Function, miss: &OutOfReach) -> GenerateError {
    let why = Diagnostic::error(miss.to_string()).with_help(miss.help());
    GenerateError::SinCos(function, why)
}

/// Refuses sines that spoil D: exact ones keep it positive definite for certain, and these do not.
fn check_inertia(
    setup: &Setup,
    generated: &GeneratedFunction,
    scalar: ScalarType,
    sines: &[AngleKernel],
) -> Result<(), GenerateError> {
    let program = &generated.program;
    // No box has all positions of a joint that slides without an end.
    let is_spoilt = has_inertia(program)
        && domain(setup, program, None).is_ok_and(|domain| {
            !is_definite(&domain, program, sines, None) && is_definite(&domain, program, &[], None)
        });
    if !is_spoilt {
        return Ok(());
    }
    let errors = sines.iter().map(|sine| sine.errors.worst());
    let worst = bound_of(errors.fold(0.0, f64::max), 2);
    let message = format!(
        "with {scalar} sines that err by up to {worst}, D cannot be shown to be positive definite \
         any more"
    );
    let help = "use a smaller `sincos_error`, or `sincos: libm`";
    let why = Diagnostic::error(message).with_help(help);
    Err(GenerateError::SinCos(generated.function, why))
}
