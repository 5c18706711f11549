//! The tolerance of a scene: its functions' programs give way to the cheapest
//! variants that it admits, each with its bounds.
//!
//! How hard to look is a matter of the request's effort, as for the exact
//! programs: little while a compiler waits, minutes for a plan.

use dalembert_model::diagnostic::Diagnostic;
use dalembert_model::scene::Tolerance;

use crate::function::Function;
use crate::generate::{GenerateError, GeneratedFunction, Job, Outcome};
use crate::program::{Program, ScalarType};
use crate::search::Effort;
use crate::setup::SceneKey;
use crate::sincos::SinCos;
use crate::task::Miss;
use crate::tolerance::budget::{Budget, Tolerances};
use crate::tolerance::search::SearchEffort;
use crate::tolerance::variant::{Variant, VariantSet};
use crate::tolerance::work::Meter;

pub(super) fn tolerate(
    job: &Job<'_>,
    functions: &mut [GeneratedFunction],
) -> Result<Vec<ScalarType>, GenerateError> {
    let is_load = |function: &&mut GeneratedFunction| function.function == Function::Load;
    let (loads, functions): (Vec<_>, Vec<_>) = functions.iter_mut().partition(is_load);
    let programs: Vec<&Program> = functions.iter().map(|f| &f.program).collect();
    let load = loads.first().map(|load| &load.program);
    let Some(variant_sets) = admitted(job, &programs, load)? else {
        return Ok(job.request.scalars.clone());
    };
    for load in loads {
        load.program = job.finished(&load.program);
    }
    let variants = variant_sets.iter().take(1).flat_map(|set| &set.variants);
    let scalars = variants.map(|variant| variant.scalar).collect();
    for (function, admitted) in functions.into_iter().zip(variant_sets) {
        function.program = job.finished(&admitted.program);
        let with_sines = (admitted.variants.iter()).filter(|variant| !variant.sines.is_empty());
        let sines = with_sines.map(|variant| (variant.scalar, variant.sines.clone()));
        function.sines = sines.collect();
        function.admitted = Some(admitted);
    }
    Ok(scalars)
}

/// Returns the variants that the scene's tolerance admits; `None` if it has no tolerance. `load` makes
/// the load of a payload, if that is an argument.
pub fn admitted(
    job: &Job<'_>,
    programs: &[&Program],
    load: Option<&Program>,
) -> Outcome<Option<Vec<VariantSet>>> {
    let request = job.request;
    let Some(tolerance) = job.tolerance() else {
        return Ok(None);
    };
    let mut choices = vec![request.scalars.clone()];
    if request.is_scalar_open && request.scalars.len() > 1 {
        // The narrow one first: it is the cheaper, in time if not in counts.
        choices = vec![vec![ScalarType::F32], vec![ScalarType::F64]];
    }
    if request.sincos_error.is_some()
        && let Some(program) = programs.first()
    {
        let message = "a scene's tolerance sets the error of its sines";
        let why = Diagnostic::error(message).with_help("leave `sincos_error` out");
        return Err(GenerateError::SinCos(program.function, why));
    }
    let mut budgets = Vec::new();
    for program in programs {
        let mut budget = Budget::new(job.setup, program, load, tolerance.relative_to)?;
        (budget.library, budget.is_fused) = (request.sincos.library(), request.fma);
        budgets.push(budget);
    }
    let meter = Meter::new(request.work);
    let last = choices.len() - 1;
    for (index, scalars) in choices.into_iter().enumerate() {
        match in_scalars(job, &budgets, &scalars, tolerance, meter) {
            Ok(admitted) => return Ok(Some(admitted)),
            // The wider scalar may do what rounding alone forbids.
            Err(
                GenerateError::Tolerance(_, Miss::Above | Miss::Indefinite | Miss::Overflow, _)
                | GenerateError::SinCos(..),
            ) if index < last => {}
            Err(error) => return Err(error),
        }
    }
    Err(GenerateError::empty())
}

/// Checks first that the tolerance admits the exact programs: a refusal comes before any search.
fn in_scalars(
    job: &Job<'_>,
    budgets: &[Budget<'_>],
    scalars: &[ScalarType],
    tolerance: &Tolerance,
    meter: Meter,
) -> Result<Vec<VariantSet>, GenerateError> {
    let mut starts = Vec::new();
    for budget in budgets {
        let allowed = budget.allowed(tolerance);
        starts.push(match usable(job, budget, &allowed, scalars)? {
            Some(planned) => (planned, true),
            None => (budget.unedited(scalars, &allowed)?, false),
        });
    }
    let mut variant_sets = Vec::new();
    for (budget, start) in budgets.iter().zip(starts) {
        let allowed = budget.allowed(tolerance);
        variant_sets.push(chosen(job, budget, start, &allowed, scalars, meter)?);
    }
    Ok(variant_sets)
}

/// Returns the variant of a plan: its bounds are found anew.
fn usable(
    job: &Job<'_>,
    budget: &Budget<'_>,
    allowed: &Tolerances,
    scalars: &[ScalarType],
) -> Result<Option<VariantSet>, GenerateError> {
    let (request, function) = (job.request, budget.exact.function);
    let (Some(plan), Some(scene)) = (&request.plan, job.setup.scene()) else {
        return Ok(None);
    };
    let scene_key = Some(SceneKey::new(scene));
    let find = |&scalar: &ScalarType| {
        let entry = plan.find(function, request.start, scalar, Some(scene), None)?;
        let is_own = entry.scene == scene_key && entry.program == *budget.exact;
        entry.edited.filter(|_| is_own)
    };
    let variants: Option<Vec<Program>> = scalars.iter().map(find).collect();
    let Some([first, rest @ ..]) = variants.as_deref() else {
        return Ok(None);
    };
    if rest.iter().any(|other| other != first) {
        return Ok(None);
    }
    let wrong = |refuted| GenerateError::Variant(function, refuted);
    Ok(budget.planned(first, scalars, allowed).map_err(wrong)?.ok())
}

/// The start is the variant of a plan, which stays, or those of the exact program, to search from.
fn chosen(
    job: &Job<'_>,
    budget: &Budget<'_>,
    (start, is_planned): (VariantSet, bool),
    allowed: &Tolerances,
    scalars: &[ScalarType],
    meter: Meter,
) -> Result<VariantSet, GenerateError> {
    let request = job.request;
    let function = budget.exact.function;
    let watch = request.watch.over(function);
    // If the observer ends the search before a function's turn, it gets the quick search,
    // which runs to its end: otherwise nothing would be left out.
    let over = watch.is_over();
    let watch = if over { Default::default() } else { watch };
    let mut effort = match request.effort {
        Effort::Thorough if !over => SearchEffort::THOROUGH,
        _ => SearchEffort::QUICK,
    };
    effort.work = request.work.map(|work| work.saturating_sub(meter.done()));
    let mut admitted = match is_planned {
        true => start,
        false => budget.choose(&[], start, allowed, &effort, watch)?,
    };
    let with = |admitted: &VariantSet| -> Result<Vec<Variant>, Diagnostic> {
        let with = |variant| budget.with_polynomials(&admitted.program, variant, allowed);
        admitted.variants.iter().map(with).collect()
    };
    match request.sincos {
        SinCos::Libm | SinCos::Together => {}
        SinCos::Auto => {
            if let Ok(variants) = with(&admitted) {
                admitted.variants = variants;
            }
        }
        SinCos::Polynomial => {
            let mut variants = with(&admitted);
            // The terms left out may have used up what polynomials need.
            if variants.is_err() {
                admitted = budget.unedited(scalars, allowed)?;
                variants = with(&admitted);
            }
            admitted.variants = variants.map_err(|why| {
                let message = format!("no polynomials for its sines within the tolerance: {why}");
                let wider = match scalars.contains(&ScalarType::F32) {
                    true => ", `scalar: f64`",
                    false => "",
                };
                let help = format!("use a larger tolerance{wider} or `sincos: libm`");
                GenerateError::SinCos(function, Diagnostic::error(message).with_help(help))
            })?;
        }
    }
    Ok(admitted)
}
