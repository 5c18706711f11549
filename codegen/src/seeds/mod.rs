//! The formulations that a function's search can start from, each as a graph.
//!
//! Takes a `Task`; returns a [`Seed`], a graph with the [`Source`] that it comes from. `Tuning`
//! carries a task through the descent to a [`ChainChoice`](tune::ChainChoice).

pub(crate) mod chain;
pub(crate) mod descent;
pub(crate) mod load;
mod size;
pub(crate) mod start;
pub(crate) mod tune;

use std::cell::RefCell;
use std::rc::Rc;

use dalembert_model::equations::Formulation;
pub(crate) use dalembert_model::equations::chain::Form;
use dalembert_model::outputs::RuntimeParameter;
use dalembert_model::scalar::Scalar;

use crate::dag::symbol::Symbol;
use crate::dag::{Builder, Dag, Folding, Node};
use crate::function::Argument;
use crate::program::{Counts, Input};
use crate::scalar::{AnyLeaves, restored};
use crate::setup::Task;
pub(crate) use chain::{regrouped, skeleton_for, trace_symbols};
pub use chain::{skeleton, trace_chain};
pub(crate) use descent::{Limit, tuned, tunings};
pub use start::Start;
pub(crate) use tune::ChainChoice;

/// Longer chains are tuned by the price before the search alone, even if that is thorough.
const MAX_QUICK_LINKS: usize = 10;

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Source {
    /// A formulation as the textbook has it.
    Formulation(Formulation),
    /// The chain formulas with regrouped parameters.
    Regrouped,
    /// The definition of a load.
    Definition,
}

impl Source {
    pub fn name(self) -> &'static str {
        match self {
            Source::Formulation(Formulation::LagrangeEuler) => "lagrange_euler",
            Source::Formulation(Formulation::Dalembert) => "dalembert",
            Source::Formulation(_) => "newton_euler",
            Source::Regrouped => "regrouped",
            Source::Definition => "definition",
        }
    }

    pub fn from_name(name: &str) -> Option<Source> {
        let textbook = start::TEXTBOOK.into_iter().map(Source::Formulation);
        let mut sources = textbook.chain([Source::Regrouped]);
        sources.find(|source| source.name() == name)
    }
}

#[derive(Clone, Debug)]
pub struct Seed {
    pub source: Source,
    /// The graph, folded as it was built, nothing more.
    pub graph: Dag,
    /// The operations of the formula as it was executed, before folding.
    pub traced: Counts,
}

/// Other inputs are zero: a search pairs all that a graph has, and they would be in its way.
pub(crate) fn reader(
    arguments: &[Argument],
    builder: &Rc<RefCell<Builder>>,
) -> impl Fn(Input) -> Symbol {
    let is_read = |argument| Argument::STATE.contains(&argument) || arguments.contains(&argument);
    move |input: Input| match is_read(input.argument()) {
        true => Symbol::input(builder, input),
        false => Symbol::zero(),
    }
}

pub(crate) fn depends_on_coulomb(task: Task<'_>) -> bool {
    if !task.setup.has_coulomb() {
        return false;
    }
    let graph = trace(task, Formulation::NewtonEulerLink).graph;
    let mut live = graph.live();
    live.any(|(_, node)| matches!(node, Node::Input(Input::PerSpeed(_))))
}

/// Returns a textbook formulation as it stands, run with symbols in a scene.
pub fn trace(task: Task<'_>, formulation: Formulation) -> Seed {
    let Task { setup, function } = task;
    let builder = Rc::new(RefCell::new(Builder::new(Folding::Syntactic)));
    // As the textbook has it, bodies are bodies and no load.
    let mut arguments = setup.arguments(function);
    let parameters = RuntimeParameter::LOADING.into_iter();
    arguments.extend(parameters.filter_map(RuntimeParameter::given));
    let leaves = (Symbol::constant, reader(&arguments, &builder));
    let symbols: Vec<Symbol> = restored(task.textbook(formulation, &AnyLeaves(&leaves)));
    let mut builder = builder.replace(Builder::new(Folding::Syntactic));
    let edges = symbols.iter().map(|symbol| symbol.edge(&mut builder));
    let outputs = edges.collect();
    Seed {
        source: Source::Formulation(formulation),
        traced: builder.asked(),
        graph: builder.finish(outputs),
    }
}
