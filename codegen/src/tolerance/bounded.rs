//! The bounds of a variant, by the checker: the numbers that `generate` writes are those that
//! `certify` finds.

use dalembert_checker::Fault;
use dalembert_checker::certify::{Demand, certify};
use dalembert_model::diagnostic::Diagnostic;

use super::claim::claim_in;
use super::reference::source;
use super::refusals::not_shown;
use super::variant::Variant;
use crate::setup::Setup;

/// Returns the variant with T and the bounds that the checker finds. A `tolerance` takes the place of
/// the scene's.
///
/// # Errors
/// The reason why the checker refuses the variant.
pub(super) fn bounded(
    setup: &Setup,
    variant: &Variant,
    tolerance: Option<f64>,
) -> Result<Variant, Diagnostic> {
    let (source, scene) = source(setup);
    let claim = claim_in(setup.robot(), &source, setup, scene.as_ref(), variant).write();
    let demand = Demand {
        scene: scene.as_ref().map(|scene| scene.name.as_str()),
        tolerance,
        worst: None,
    };
    let report = certify(&variant.with_load(), &claim, &source, &demand);
    let name = variant.emitted.function.name();
    let findings = report
        .and_then(|report| {
            let lines = report.lines.into_iter();
            let shown = lines
                .map(|line| Ok((line.result?, line.name)))
                .collect::<Result<Vec<_>, Fault>>()?;
            let entry = shown.into_iter().find(|entry| entry.1 == name);
            let none = || Fault::Claim("the function is not in the file".into());
            Ok(entry.ok_or_else(none)?.0)
        })
        .map_err(|fault| not_shown(variant, &fault))?;
    Ok(Variant {
        bounds: findings
            .results
            .iter()
            .map(|bound| bound.relative())
            .collect(),
        scales: findings.results.iter().map(|bound| bound.scale).collect(),
        ..variant.clone()
    })
}
