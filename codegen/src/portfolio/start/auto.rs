//! The chain formulas in the regrouping that is cheapest, with the recursion's values
//! at hand.

use dalembert_model::equations::Formulation;
use dalembert_model::outputs::RuntimeParameter;

use super::{Beginning, Problem};
use crate::function::Function;
use crate::graph::Graph;
use crate::portfolio::tune::Tuned;
use crate::portfolio::{Source, Sums, Variant, angle_sums, regrouped, textbook, tuned};
use crate::scene::SceneRobot;

/// The start `auto`.
pub(super) struct Auto;

impl Beginning for Auto {
    fn name(&self) -> &'static str {
        "auto"
    }

    fn variants(&self, problem: &Problem<'_>) -> (Option<Tuned>, Vec<Variant>) {
        variants(problem)
    }

    fn helpers(&self, scene_robot: &SceneRobot) -> Vec<Graph> {
        vec![angle_sums(scene_robot, Sums::Products)]
    }

    fn has_chain(&self) -> bool {
        true
    }

    fn may_regroup(&self) -> bool {
        true
    }
}

pub(super) fn variants(problem: &Problem<'_>) -> (Option<Tuned>, Vec<Variant>) {
    let Problem {
        scene_robot,
        function,
        effort,
        limit,
        from,
        watch,
    } = *problem;
    if function == Function::Load {
        let mut definition = textbook(scene_robot, function, Formulation::NewtonEulerLink);
        definition.source = Source::Definition;
        return (None, vec![definition]);
    }
    let mut quantities = function.quantities().iter();
    if !quantities.any(|quantity| quantity.is_regrouped()) {
        let forms = [Formulation::NewtonEulerLink, Formulation::LagrangeEuler];
        let variants = forms.map(|f| textbook(scene_robot, function, f));
        return (None, variants.into());
    }
    let tuned = tuned(scene_robot, function, effort, limit, from, watch);
    let mut variants = regrouped(scene_robot, function, &tuned.regrouping);
    // The textbook recursion gives D column by column and h_ikm by polarisation, with n²
    // of work a link or more: no match.
    let mut quantities = function.quantities().iter();
    // It has no load, but a body in the hand.
    let is_loaded = scene_robot.takes(function, RuntimeParameter::Payload);
    if !is_loaded && quantities.all(|quantity| quantity.starts_from_recursion()) {
        variants.push(textbook(
            scene_robot,
            function,
            Formulation::NewtonEulerLink,
        ));
    }
    (Some(tuned), variants)
}
