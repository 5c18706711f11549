//! Functions by the textbook formulations, traced as they stand.

use dalembert_model::equations::Formulation;

use super::{Source, Variant};
use crate::function::Function;
use crate::scene::SceneRobot;
use crate::trace::trace;

/// Returns a textbook formulation.
pub(crate) fn textbook(
    scene_robot: &SceneRobot,
    function: Function,
    formulation: Formulation,
) -> Variant {
    let trace = trace(scene_robot, function, formulation);
    Variant {
        source: Source::Textbook(formulation),
        graph: trace.graph,
        traced: trace.traced,
    }
}
