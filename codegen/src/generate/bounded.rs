//! The bounds of a variant, by the checker: the numbers that `generate` writes are those that
//! `certify` finds.

use dalembert_checker::certify::{Demand, certify};
use dalembert_model::robot::write;
use dalembert_model::scene::{self, Scene};

use super::claim::claim_of;
use crate::certificate::Certificate;
use crate::setup::Setup;
use crate::split::ErrorByCause;
use crate::words::{Complaint, complaint};

/// Returns the claim with T and the bounds that the checker finds. A `tolerance` takes the place of
/// the scene's.
///
/// # Errors
/// The reason why the checker refuses the variant.
pub fn bounded(
    setup: &Setup,
    own: &Certificate,
    tolerance: Option<f64>,
) -> Result<Certificate, Complaint> {
    // Gravity, payload and box are the robot's already.
    let scene = setup.scene().map(|scene| Scene {
        gravity: None,
        payload: None,
        bounds: Default::default(),
        ..scene.clone()
    });
    let robot = setup.robot();
    let table = scene.as_ref().map_or_else(String::new, scene::write);
    let source = format!("{}\n{table}", write(robot));
    let claim = claim_of(robot, &source, setup, own).write();
    let demand = Demand {
        scene: scene.as_ref().map(|scene| scene.name.as_str()),
        tolerance,
        worst: None,
    };
    let refused = |why: String| {
        let scalar = own.scalar;
        complaint(format!(
            "in {scalar} the checker does not show the variant: {why}"
        ))
    };
    let report = certify(&own.text, &claim, &source, &demand);
    let report = report.map_err(|fault| refused(fault.to_string()))?;
    let line = report.lines.into_iter().next();
    let found = line
        .ok_or_else(|| refused("there is no function".into()))?
        .result;
    let found = found.map_err(|fault| refused(fault.to_string()))?.results;
    let up = |size: f64, unit: f64| match size == 0.0 {
        true => 0.0,
        false => (size / unit).next_up(),
    };
    let bounds = found.iter().map(|own| ErrorByCause {
        model: up(own.real, own.unit()),
        sincos: 0.0,
        rounding: up(own.rounding, own.unit()),
    });
    Ok(Certificate {
        bounds: bounds.collect(),
        scales: found.iter().map(|own| own.scale).collect(),
        ..own.clone()
    })
}
