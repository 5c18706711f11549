//! The tolerance of a scene: its functions' programs give way to the cheapest
//! variants that it admits, each with its certificates.
//!
//! How hard to look is a matter of the request's effort, as for the exact
//! programs: little while a compiler waits, minutes for a plan.

use dalembert_model::scene::Tolerance;

use crate::certify::certificate::Certificate;
use crate::certify::certificate::subject::Fineness;
use crate::certify::choose::{Admitted, Claim, Frame, NoPolynomials, Refusal};
use crate::certify::prune::Settings;
use crate::emit::ScalarType;
use crate::function::Function;
use crate::generate::{GenerateError, GeneratedFunction, Request, Start};
use crate::plan::{Edited, SceneKey};
use crate::scene::Setting;
use crate::schedule::Program;
use crate::simplify::Effort;
use crate::sincos::SinCos;

/// Replaces the programs, if the scene has a tolerance. Returns the scalars to
/// emit.
pub(super) fn tolerate(
    setting: &Setting,
    functions: &mut [GeneratedFunction],
    request: &Request,
) -> Result<Vec<ScalarType>, GenerateError> {
    let programs: Vec<&Program> = functions.iter().map(|f| &f.program).collect();
    let Some(all) = admitted(setting, &programs, request)? else {
        return Ok(request.scalars.clone());
    };
    // One a certificate, the same of every function.
    let certificates = all
        .iter()
        .take(1)
        .flat_map(|admitted| &admitted.certificates);
    let scalars = certificates.map(|certificate| certificate.scalar).collect();
    for (function, admitted) in functions.iter_mut().zip(all) {
        function.program = admitted.program.clone();
        function.counts = admitted.program.counts();
        let sines = admitted.certificates.iter();
        let sines = sines.filter(|c| !c.sines.is_empty());
        function.sines = sines.map(|c| (c.scalar, c.sines.clone())).collect();
        function.admitted = Some(admitted);
    }
    Ok(scalars)
}

/// What the scene's tolerance admits in place of each exact program; `None` if
/// it has none.
pub(crate) fn admitted(
    setting: &Setting,
    programs: &[&Program],
    request: &Request,
) -> Result<Option<Vec<Admitted>>, GenerateError> {
    let scene = setting.scene();
    let Some(tolerance) = scene.and_then(|scene| scene.tolerance.as_ref()) else {
        return Ok(None);
    };
    let mut choices = vec![request.scalars.clone()];
    if request.any_scalar && request.scalars.len() > 1 {
        // The narrow one first: it is the cheaper, in time if not in counts.
        choices = vec![vec![ScalarType::F32], vec![ScalarType::F64]];
    }
    let last = choices.len() - 1;
    for (index, scalars) in choices.into_iter().enumerate() {
        let admit = |program: &&Program| one(setting, program, tolerance, &scalars, request);
        let admitted: Result<Vec<Admitted>, GenerateError> = programs.iter().map(admit).collect();
        match admitted {
            Ok(admitted) => return Ok(Some(admitted)),
            // What rounding alone forbids, the wider scalar may do.
            Err(
                GenerateError::Tolerance(_, Refusal::Above { .. } | Refusal::Indefinite(_))
                | GenerateError::SinCos(..),
            ) if index < last => {}
            Err(error) => return Err(error),
        }
    }
    Err(GenerateError::Empty)
}

fn one(
    setting: &Setting,
    program: &Program,
    tolerance: &Tolerance,
    scalars: &[ScalarType],
    request: &Request,
) -> Result<Admitted, GenerateError> {
    let function = program.function;
    let fail = |refusal| GenerateError::Tolerance(function, refusal);
    if matches!(request.sincos, SinCos::Polynomial { error: Some(_) }) {
        let why = "a scene's tolerance decides how exact its sines are: give no error for them";
        return Err(GenerateError::SinCos(function, why.into()));
    }
    let watch = request.watch.over(function);
    let frame = Frame::new(setting, program, tolerance.relative_to).map_err(fail)?;
    // Who wants an end before a function's turn gets the quick search for it,
    // which nobody ends: it would leave out nothing.
    let over = watch.is_over();
    let frame = if over { frame } else { frame.watched(watch) };
    let tolerances = frame.tolerances(tolerance);
    let (settings, fineness) = match request.effort {
        Effort::Quick => (QUICK, Fineness::GLANCE),
        Effort::Thorough if over => (QUICK, Fineness::CERTIFY),
        Effort::Thorough => (thorough(request), Fineness::CERTIFY),
    };
    // A plan's bounds are not found anew, but they are compared.
    let kept = kept(&frame, function, scalars, request)?;
    let admitted = match kept.filter(|kept| kept.within(&tolerances).is_ok()) {
        Some(kept) => kept,
        None => frame
            .choose(&tolerances, scalars, &settings, fineness)
            .map_err(fail)?,
    };
    // Always as fine, so that a plan's variant gets the sines that it got when
    // it was found.
    let with = |certificate: &Certificate| {
        frame.with_polynomials(certificate, &tolerances, Fineness::GLANCE)
    };
    let all = |admitted: &Admitted| -> Result<Vec<Certificate>, NoPolynomials> {
        admitted.certificates.iter().map(with).collect()
    };
    match request.sincos {
        SinCos::Libm => Ok(admitted),
        SinCos::Auto => {
            let or_libm = |c: &Certificate| with(c).unwrap_or_else(|_| c.clone());
            let certificates = admitted.certificates.iter().map(or_libm).collect();
            Ok(Admitted {
                certificates,
                ..admitted
            })
        }
        SinCos::Polynomial { .. } => {
            // What was left out may have used up what polynomials need.
            let found = all(&admitted).map(|certificates| (admitted, certificates));
            let found = found.or_else(|_| {
                let exact = frame.unedited(scalars, fineness);
                all(&exact).map(|certificates| (exact, certificates))
            });
            let (admitted, certificates) = found.map_err(|why| {
                let why = format!("no polynomials for its sines within the tolerance: {why}");
                GenerateError::SinCos(function, why)
            })?;
            Ok(Admitted {
                certificates,
                ..admitted
            })
        }
    }
}

/// Another gauge may be looked for only where the start may be any.
fn thorough(request: &Request) -> Settings {
    let sweeps = match request.start {
        Start::Auto => Settings::THOROUGH.sweeps,
        Start::AngleSums | Start::Only(_) => 0,
    };
    Settings {
        sweeps,
        ..Settings::THOROUGH
    }
}

/// For who waits: seconds for a six-joint arm.
const QUICK: Settings = Settings {
    samples: 24,
    guesses: 4,
    retries: 0,
    stages: 3,
    alike: 2,
    sweeps: 0,
    budget: Fineness::GLANCE.budget,
    effort: Effort::Quick,
    refit: true,
};

/// The plan's variant, if it has the same one for each of the scalars.
fn kept(
    frame: &Frame<'_>,
    function: Function,
    scalars: &[ScalarType],
    request: &Request,
) -> Result<Option<Admitted>, GenerateError> {
    let (Some(plan), Some(scene)) = (&request.plan, frame.setting.scene()) else {
        return Ok(None);
    };
    let scene_key = Some(SceneKey::of(scene));
    let find = |&scalar: &ScalarType| {
        let entry = plan.find(function, request.start, scalar, Some(scene))?;
        (entry.scene == scene_key && entry.program == *frame.exact)
            .then_some(entry.edited.as_ref())
            .flatten()
    };
    let variants: Option<Vec<&Edited>> = scalars.iter().map(find).collect();
    let Some([first, rest @ ..]) = variants.as_deref() else {
        return Ok(None);
    };
    let same = |other: &&Edited| other.stages == first.stages && other.program == first.program;
    if !rest.iter().all(same) {
        return Ok(None);
    }
    let pairs = scalars.iter().zip(variants.iter().flatten());
    let claims = pairs.map(|(&scalar, variant)| Claim {
        scalar,
        bounds: variant.bounds.clone(),
        lambda_min: variant.lambda_min,
    });
    let claims: Vec<Claim> = claims.collect();
    frame
        .replayed(&first.stages, &first.program, &claims)
        .map(Some)
        .map_err(|refuted| GenerateError::Variant(function, refuted))
}
