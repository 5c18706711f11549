//! The bounds of a variant, by the checker: the numbers that `generate` writes are those that
//! `certify` finds.

use dalembert_checker::Fault;
use dalembert_checker::certify::{Demand, certify};

use super::claim::claim_in;
use super::reference::source;
use super::refusals::above;
use super::variant::{Bound, Variant};
use crate::setup::Setup;
use crate::words::Complaint;

/// Returns the variant with T and the bounds that the checker finds. A `tolerance` takes the place of
/// the scene's.
///
/// # Errors
/// The reason why the checker refuses the variant.
pub(super) fn bounded(
    setup: &Setup,
    own: &Variant,
    tolerance: Option<f64>,
) -> Result<Variant, Complaint> {
    let (source, scene) = source(setup);
    let claim = claim_in(setup.robot(), &source, setup, scene.as_ref(), own).write();
    let demand = Demand {
        scene: scene.as_ref().map(|scene| scene.name.as_str()),
        tolerance,
        worst: None,
    };
    let report = certify(&own.with_load(), &claim, &source, &demand);
    let name = own.emitted.function.name();
    let found = report.and_then(|report| {
        let lines = report.lines.into_iter();
        let shown = lines.map(|line| Ok((line.result?, line.name)));
        let shown = shown.collect::<Result<Vec<_>, Fault>>()?;
        let found = shown.into_iter().find(|own| own.1 == name);
        let none = || Fault::Claim("there is no function".into());
        Ok(found.ok_or_else(none)?.0)
    });
    let found = found.map_err(|fault| above(own, &fault))?;
    let up = |size: f64, unit: f64| match size == 0.0 {
        true => 0.0,
        false => (size / unit).next_up(),
    };
    let bounds = found.results.iter().map(|own| Bound {
        real: up(own.real, own.unit()),
        rounding: up(own.rounding, own.unit()),
    });
    Ok(Variant {
        bounds: bounds.collect(),
        scales: found.results.iter().map(|own| own.scale).collect(),
        ..own.clone()
    })
}
