//! One textbook formulation and nothing else.

use dalembert_model::equations::Formulation;

use super::{Beginning, Problem};
use crate::portfolio::tune::Tuned;
use crate::portfolio::{Source, Variant, textbook};

/// The formulations that can be asked for by name. Of the recursion in link axes it is
/// the one that is cheapest.
pub(in crate::portfolio) const TEXTBOOK: [Formulation; 3] = [
    Formulation::LagrangeEuler,
    Formulation::Dalembert,
    Formulation::NewtonEulerLink,
];

/// A formulation.
pub(super) struct Only(pub(super) Formulation);

impl Beginning for Only {
    fn name(&self) -> &'static str {
        Source::Textbook(self.0).name()
    }

    fn variants(&self, problem: &Problem<'_>) -> (Option<Tuned>, Vec<Variant>) {
        let variant = textbook(problem.scene_robot, problem.function, self.0);
        (None, vec![variant])
    }
}
