//! The tolerance of a scene: its functions' programs give way to the cheapest
//! variants that it admits, each with its certificates.
//!
//! How hard to look is a matter of the request's effort, as for the exact
//! programs: little while a compiler waits, minutes for a plan.

use dalembert_model::scene::Tolerance;

use crate::approximate::admitted::Admitted;
use crate::approximate::choose::ErrorBudget;
use crate::approximate::error::ToleranceError;
use crate::approximate::prune::PruneSettings;
use crate::bound::sensitivity::BoundEffort;
use crate::bound::work::Meter;
use crate::certificate::Certificate;
use crate::generate::bounded::bounded;
use crate::generate::{GenerateError, GeneratedFunction, Job};
use crate::plan::Edited;
use crate::program::{Program, ScalarType};
use crate::search::Effort;
use crate::seeds::Start;
use crate::setup::SceneKey;
use crate::sincos::SinCos;
use crate::words::{Complaint, complaint};

pub(super) fn tolerate(
    job: &Job<'_>,
    functions: &mut [GeneratedFunction],
) -> Result<Vec<ScalarType>, GenerateError> {
    let programs: Vec<&Program> = functions.iter().map(|f| &f.program).collect();
    let Some(all) = admitted(job, &programs)? else {
        return Ok(job.request.scalars.clone());
    };
    let certificates = all.first().map_or(&[][..], |own| &own.certificates).iter();
    let scalars = certificates.map(|certificate| certificate.scalar).collect();
    for (function, admitted) in functions.iter_mut().zip(all) {
        function.program = job.finished(&admitted.program);
        let sines = admitted.certificates.iter();
        let sines = sines.filter(|c| !c.sines.is_empty());
        function.sines = sines.map(|c| (c.scalar, c.sines.clone())).collect();
        function.admitted = Some(admitted);
    }
    Ok(scalars)
}

/// Returns the variants that the scene's tolerance admits; `None` if it has no tolerance.
pub fn admitted(
    job: &Job<'_>,
    programs: &[&Program],
) -> Result<Option<Vec<Admitted>>, GenerateError> {
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
        let message = "a scene's tolerance decides how exact its sines are";
        let why = Complaint::new(message, "give no error for them");
        return Err(GenerateError::SinCos(program.function, why));
    }
    let mut budgets = Vec::new();
    for program in programs {
        let budget = ErrorBudget::new(job.setup, program, tolerance.relative_to);
        budgets.push(budget.map_err(|why| GenerateError::Tolerance(program.function, why))?);
    }
    let meter = Meter::new(request.work);
    let last = choices.len() - 1;
    for (index, scalars) in choices.into_iter().enumerate() {
        match in_scalars(job, &budgets, tolerance, &scalars, meter) {
            Ok(admitted) => return Ok(Some(admitted)),
            // What rounding alone forbids, the wider scalar may do.
            Err(
                GenerateError::Tolerance(
                    _,
                    ToleranceError::Above(_)
                    | ToleranceError::Indefinite(_)
                    | ToleranceError::Overflow(_),
                )
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
    budgets: &[ErrorBudget<'_>],
    tolerance: &Tolerance,
    scalars: &[ScalarType],
    meter: Meter,
) -> Result<Vec<Admitted>, GenerateError> {
    let mut planned = Vec::new();
    for budget in budgets {
        let tolerances = budget.tolerances(tolerance);
        let usable = usable(job, budget, &tolerances, scalars)?;
        if usable.is_none() {
            let exact = budget.unedited(scalars, bound_effort(job));
            let refused = exact.within(&tolerances);
            let refused = refused.and_then(|()| budget.definite(scalars));
            refused.map_err(|why| GenerateError::Tolerance(budget.exact.function, why))?;
        }
        planned.push(usable);
    }
    let each = budgets.iter().zip(planned);
    each.map(|(budget, planned)| chosen(job, budget, planned, tolerance, scalars, meter))
        .collect()
}

fn bound_effort(job: &Job<'_>) -> BoundEffort {
    match job.request.effort {
        Effort::Quick => BoundEffort::QUICK,
        Effort::Thorough => BoundEffort::CERTIFY,
    }
}

/// A plan is a text that anybody can edit: the variant's bounds are found anew.
fn usable(
    job: &Job<'_>,
    budget: &ErrorBudget<'_>,
    tolerances: &[f64],
    scalars: &[ScalarType],
) -> Result<Option<Admitted>, GenerateError> {
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
    let variants: Option<Vec<Edited>> = scalars.iter().map(find).collect();
    let Some([first, rest @ ..]) = variants.as_deref() else {
        return Ok(None);
    };
    if rest.iter().any(|other| other.program != first.program) {
        return Ok(None);
    }
    let found = budget.shown(&first.program, &first.left_out, scalars, tolerances);
    let found = found.map_err(|refuted| GenerateError::Variant(function, refuted))?;
    let is_usable = found.within(tolerances).is_ok() && found.is_definite();
    Ok(is_usable.then_some(found))
}

fn chosen(
    job: &Job<'_>,
    budget: &ErrorBudget<'_>,
    planned: Option<Admitted>,
    tolerance: &Tolerance,
    scalars: &[ScalarType],
    meter: Meter,
) -> Result<Admitted, GenerateError> {
    let request = job.request;
    let function = budget.exact.function;
    let fail = |refusal| GenerateError::Tolerance(function, refusal);
    let watch = request.watch.over(function);
    // Who wants an end before a function's turn gets the quick search for it,
    // which nobody ends: it would leave out nothing.
    let over = watch.is_over();
    let budget = match over {
        true => budget.clone(),
        false => budget.clone().watched(watch),
    };
    let tolerances = budget.tolerances(tolerance);
    let bound_effort = bound_effort(job);
    let mut settings = match request.effort {
        Effort::Thorough if !over => PruneSettings::THOROUGH,
        _ => PruneSettings::QUICK,
    };
    // Another regrouping may be looked for only where the start may be any.
    if request.start != Start::Auto {
        settings.sweeps = 0;
    }
    settings.work = request.work.map(|work| work.saturating_sub(meter.done()));
    let mut admitted = match planned {
        Some(planned) => planned,
        None => {
            let found = budget.choose(&[], &tolerances, scalars, &settings, bound_effort);
            let found = found.map_err(fail)?;
            // A quick search has bounded it so already.
            match bound_effort == BoundEffort::QUICK {
                true => found,
                false => budget
                    .shown(&found.program, &found.left_out, scalars, &tolerances)
                    .map_err(|why| GenerateError::Defect(function, None, why.to_string()))?,
            }
        }
    };
    // Always as fine, so that a plan's variant gets the sines that it got when it was found.
    let with = |certificate: &Certificate| {
        budget.with_polynomials(certificate, &tolerances, BoundEffort::QUICK)
    };
    let libm = admitted.certificates.clone();
    match request.sincos {
        SinCos::Libm | SinCos::Together => {}
        SinCos::Auto => {
            for certificate in &mut admitted.certificates {
                if let Ok(found) = with(certificate) {
                    *certificate = found;
                }
            }
        }
        SinCos::Polynomial => {
            let all = |admitted: &Admitted| -> Result<Vec<Certificate>, Complaint> {
                admitted.certificates.iter().map(with).collect()
            };
            // What was left out may have used up what polynomials need.
            let found = all(&admitted).or_else(|_| {
                admitted = budget.unedited(scalars, bound_effort);
                all(&admitted)
            });
            admitted.certificates = found.map_err(|why| {
                let message = format!("no polynomials for its sines within the tolerance: {why}");
                let wider = match scalars.contains(&ScalarType::F32) {
                    true => ", `scalar: f64`",
                    false => "",
                };
                let help = format!("use a larger tolerance{wider} or `sincos: libm`");
                GenerateError::SinCos(function, Complaint::new(message, help))
            })?;
        }
    }
    let mut called = admitted.clone();
    called.certificates = libm;
    let shown = |admitted: Admitted| shown(job, &budget, admitted, &tolerances, bound_effort);
    let has_polynomials = called.certificates != admitted.certificates;
    let mut found = shown(admitted);
    // What the checker does not show gives way to what it does.
    if found.is_err() && has_polynomials && request.sincos == SinCos::Auto {
        found = shown(called).or(found);
    }
    if found.is_err() && request.sincos != SinCos::Polynomial {
        found = shown(budget.unedited(scalars, bound_effort)).or(found);
    }
    found.map_err(|why| fail(ToleranceError::Above(why)))
}

/// Returns a variant with the bounds that the checker finds.
fn shown(
    job: &Job<'_>,
    budget: &ErrorBudget<'_>,
    mut admitted: Admitted,
    tolerances: &[f64],
    bound_effort: BoundEffort,
) -> Result<Admitted, Complaint> {
    let finished = job.finished(&admitted.program);
    if finished != admitted.program {
        for certificate in &mut admitted.certificates {
            let found = budget.with_emitted(certificate, &finished, tolerances, bound_effort);
            *certificate = found.map_err(|why| complaint(why.to_string()))?;
        }
    }
    for certificate in &mut admitted.certificates {
        let printed = certificate.calling(job.request.library());
        *certificate = bounded(job.setup, &printed, None)?;
    }
    Ok(admitted)
}
