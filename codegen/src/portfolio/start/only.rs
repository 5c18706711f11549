//! One textbook formulation and nothing else.

use dalembert_model::equations::Formulation;

use super::{Approach, Beginning, Problem};
use crate::portfolio::{Source, textbook};

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

    fn approaches(&self, problem: &Problem<'_>) -> Vec<Approach> {
        let variant = textbook(problem.scene_robot, problem.function, self.0);
        vec![Approach::of(variant)]
    }
}
