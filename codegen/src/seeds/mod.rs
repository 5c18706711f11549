//! The formulations that a function's search can start from, each as a graph.
//!
//! - this file: [`Seed`], a graph to start from, and its [`Source`]
//! - [`start`]: what a search starts from, by the formulation that was asked for
//! - [`chain`]: the chain forms ([`dalembert_model::equations::chain`]) in a regrouping
//! - [`descent`]: the regrouping that is cheapest for the robot and the function;
//!   [`tune`]: how a descent goes from one to the next
//! - [`load`]: the numbers of the chain that a payload changes, and how formulas read them
//! - `trace`: a textbook formulation as it stands

pub(crate) mod chain;
pub(crate) mod descent;
pub(crate) mod load;
pub(crate) mod start;
mod trace;
pub(crate) mod tune;

use dalembert_model::equations::Formulation;

use crate::dag::Dag;
use crate::program::Counts;
pub(crate) use chain::regrouped;
pub use chain::{skeleton, skeleton_for, trace_chain};
pub(crate) use descent::{Limit, tuned};
pub use start::Start;
pub(crate) use trace::depends_on_coulomb;
pub use trace::trace;
pub(crate) use tune::Tuned;

pub(crate) use dalembert_model::equations::chain::Form;

/// Longer chains are tuned by the price before the search alone.
const MAX_QUICK_LINKS: usize = 10;

/// The formula behind a graph.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Source {
    /// A formulation as the textbook has it.
    Textbook(Formulation),
    /// The chain formulas with regrouped parameters.
    Regrouped,
    /// The definition of a load.
    Definition,
}

impl Source {
    /// Returns its name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Source::Textbook(Formulation::LagrangeEuler) => "lagrange_euler",
            Source::Textbook(Formulation::Dalembert) => "dalembert",
            Source::Textbook(_) => "newton_euler",
            Source::Regrouped => "regrouped",
            Source::Definition => "definition",
        }
    }

    /// Returns the source of a name.
    pub fn from_name(name: &str) -> Option<Source> {
        let textbook = start::TEXTBOOK.into_iter().map(Source::Textbook);
        let mut all = textbook.chain([Source::Regrouped]);
        all.find(|source| source.name() == name)
    }
}

/// A graph of a function to start from.
#[derive(Clone, Debug)]
pub struct Seed {
    /// Where it comes from.
    pub source: Source,
    /// The graph, folded as it was built, nothing more.
    pub graph: Dag,
    /// The operations of the formula as it was executed, before folding.
    pub traced: Counts,
}
