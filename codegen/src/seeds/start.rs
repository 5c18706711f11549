//! The starts of a function's search, by the formulation that was asked for.

use dalembert_model::equations::Formulation;
use dalembert_model::equations::chain::{Chain, Regrouping};
use dalembert_model::number::Exact;

use super::{ChainChoice, Form, Limit, Seed, Source, regrouped, skeleton_for, trace, tunings};
use crate::dag::Dag;
use crate::function::Function;
use crate::search::Effort;
use crate::setup::Task;
use crate::watch::FunctionWatch;
use crate::words::Word;

/// The formulations by name, with the cheapest of the recursion in link axes.
pub(super) const TEXTBOOK: [Formulation; 3] = [
    Formulation::LagrangeEuler,
    Formulation::Dalembert,
    Formulation::NewtonEulerLink,
];

/// The formulation that a function starts from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Start {
    /// The cheapest, with the others' values at hand.
    #[default]
    Auto,
    /// One textbook formulation only.
    Only(Formulation),
}

impl Start {
    /// Returns its name on the command line, in the macro and in plans.
    pub fn name(self) -> &'static str {
        match self {
            Start::Auto => "auto",
            Start::Only(formulation) => Source::Formulation(formulation).name(),
        }
    }

    /// Returns the recursion in link axes alone: what rounding is held against. It has no load.
    pub(crate) fn textbook(task: Task<'_>) -> Option<Approach> {
        let is_loaded = task.setup.takes_load(task.function);
        (!is_loaded).then(|| Approach::of(vec![trace(task, Formulation::NewtonEulerLink)]))
    }

    pub(crate) fn approaches(self, problem: &Tuning<'_>) -> Vec<Approach> {
        let task = problem.task;
        let function = task.function;
        let mut quantities = function.quantities().iter();
        match self {
            Start::Only(form) => vec![Approach::of(vec![trace(task, form)])],
            Start::Auto if function == Function::Load => {
                let mut definition = trace(task, Formulation::NewtonEulerLink);
                definition.source = Source::Definition;
                vec![Approach::of(vec![definition])]
            }
            Start::Auto if quantities.any(|quantity| quantity.is_regrouped()) => by_chain(problem),
            Start::Auto => by_textbook(problem),
        }
    }
}

impl Word for Start {
    const WHAT: &'static str = "formulation";

    fn all() -> Vec<(&'static str, Start)> {
        let starts = [Start::Auto].into_iter().chain(TEXTBOOK.map(Start::Only));
        starts.map(|start| (start.name(), start)).collect()
    }
}

pub(crate) struct Approach {
    pub tuned: Option<ChainChoice>,
    /// The graphs, of which the cheapest is the first program.
    pub seeds: Vec<Seed>,
    /// Graphs of the function that only offer their values.
    pub helpers: Vec<Dag>,
}

impl Approach {
    pub(crate) fn of(seeds: Vec<Seed>) -> Approach {
        Approach {
            tuned: None,
            seeds,
            helpers: Vec::new(),
        }
    }
}

#[derive(Clone, Copy)]
pub(crate) struct Tuning<'a> {
    pub task: Task<'a>,
    pub effort: Effort,
    pub limit: Option<Limit<'a>>,
    pub from: &'a [Regrouping<Exact>],
    pub watch: FunctionWatch<'a>,
}

impl<'a> Tuning<'a> {
    pub(crate) fn new(task: Task<'a>, effort: Effort) -> Tuning<'a> {
        Tuning {
            task,
            effort,
            limit: None,
            from: &[],
            watch: FunctionWatch::default(),
        }
    }
}

/// From the recursion or Lagrange–Euler, whichever is cheaper, and from other forms: these are
/// small, and a form that is dearer by itself often ends lower.
fn by_textbook(problem: &Tuning<'_>) -> Vec<Approach> {
    let textbook = |form| trace(problem.task, form);
    let recursion = textbook(Formulation::NewtonEulerLink);
    let products = textbook(Formulation::LagrangeEuler);
    let printed = textbook(Formulation::NewtonEulerLinkAsPrinted);
    let helpers = vec![products.graph.clone(), printed.graph.clone()];
    let mut others = vec![
        printed,
        textbook(Formulation::Dalembert),
        textbook(Formulation::NewtonEulerBase),
    ];
    others.retain(|seed| seed.graph != recursion.graph);
    others.dedup_by(|second, first| second.graph == first.graph);
    let others = others.into_iter().map(|seed| Approach {
        helpers: helpers.clone(),
        ..Approach::of(vec![seed])
    });
    let both = Approach::of(vec![recursion, products]);
    [both].into_iter().chain(others).collect()
}

fn by_chain(problem: &Tuning<'_>) -> Vec<Approach> {
    let task = problem.task;
    let Task { setup, function } = task;
    // Where no axes meet at the base, the forms that need it are the others.
    let arm = skeleton_for(task);
    let chain = Chain::new(&arm, &Regrouping::base(&arm));
    let has_shoulder = chain.base.is_some() || chain.has_shoulder();
    let mut forms = function.forms();
    forms.retain(|form| has_shoulder || !form.shoulder);
    let (first, second) = tunings(problem, &forms);
    let approach = |tuned: ChainChoice| {
        // Seen in other axes the hand has hardly a value in common.
        let like = forms.iter().filter(|form| form.hand == tuned.form.hand);
        let mut seeds = regrouped(task, &like.copied().collect::<Vec<Form>>(), &tuned);
        // The textbook recursion gives D column by column and h_ikm by polarisation, with
        // n² of work a link or more: no match. It has no load, but a body in the hand.
        let mut quantities = function.quantities().iter();
        let is_loaded = setup.takes_load(function);
        if !is_loaded && quantities.all(|quantity| quantity.facts().starts_from_recursion) {
            seeds.push(trace(task, Formulation::NewtonEulerLink));
        }
        Approach {
            tuned: Some(tuned),
            ..Approach::of(seeds)
        }
    };
    [first].into_iter().chain(second).map(approach).collect()
}
