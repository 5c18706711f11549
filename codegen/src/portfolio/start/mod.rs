//! Starts: the formulations that a function's search begins with.
//!
//! - this file: [`Start`], the choices by name
//! - `auto`: the approaches of the cheapest, with the others' values at hand

mod auto;

use dalembert_model::equations::Formulation;
use dalembert_model::equations::chain::Regrouping;
use dalembert_model::number::Exact;

use super::{Limit, Source, Sums, Variant, angle_sums, textbook, tune::Tuned};
use crate::function::Function;
use crate::graph::Graph;
use crate::scene::SceneRobot;
use crate::simplify::{Effort, WaySource};
use crate::watch::FunctionWatch;
use crate::words::Word;

/// The formulations that can be asked for by name. Of the recursion in link axes it is
/// the one that is cheapest.
pub(super) const TEXTBOOK: [Formulation; 3] = [
    Formulation::LagrangeEuler,
    Formulation::Dalembert,
    Formulation::NewtonEulerLink,
];

/// Which formulation a function starts from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Start {
    /// The cheapest, with the others' values at hand.
    #[default]
    Auto,
    /// As [`Start::Auto`], where the sines and cosines of angle sums of
    /// parallel joints may be evaluated instead of formed: fewer operations,
    /// a pair more, and an error of |q| u in the sum.
    AngleSums,
    /// One textbook formulation only.
    Only(Formulation),
}

impl Start {
    /// Returns the choices of the command line and the macro.
    pub fn all() -> impl Iterator<Item = Start> {
        let textbook = TEXTBOOK.into_iter().map(Start::Only);
        [Start::Auto, Start::AngleSums].into_iter().chain(textbook)
    }

    /// Returns its name on the command line, in the macro and in plans.
    pub fn name(self) -> &'static str {
        match self {
            Start::Auto => "auto",
            Start::AngleSums => "angle_sums",
            Start::Only(formulation) => Source::Textbook(formulation).name(),
        }
    }

    /// Returns whether functions that it starts can take a load: numbers of the chain formulas.
    pub fn has_chain(self) -> bool {
        !matches!(self, Start::Only(_))
    }

    /// Returns whether a tolerance may be met in another regrouping than that which is
    /// cheapest without one.
    pub fn may_regroup(self) -> bool {
        self == Start::Auto
    }

    /// Returns graphs whose values no formula forms but that may shorten one.
    pub(crate) fn helpers(self, scene_robot: &SceneRobot) -> Vec<Graph> {
        match self {
            Start::Auto => vec![angle_sums(scene_robot, Sums::Products)],
            Start::AngleSums => vec![angle_sums(scene_robot, Sums::Inputs)],
            Start::Only(_) => Vec::new(),
        }
    }

    /// Returns the approaches, each searched by itself: the cheapest that is found is taken.
    pub(crate) fn approaches(self, problem: &Problem<'_>) -> Vec<Approach> {
        match self {
            Start::Auto | Start::AngleSums => auto::approaches(problem),
            Start::Only(formulation) => {
                let variant = textbook(problem.scene_robot, problem.function, formulation);
                vec![Approach::of(variant)]
            }
        }
    }
}

impl Word for Start {
    const WHAT: &'static str = "formulation";

    fn all() -> Vec<(&'static str, Start)> {
        Start::all().map(|start| (start.name(), start)).collect()
    }
}

/// What one search starts from.
pub(crate) struct Approach {
    /// The regrouping that was chosen, if one was.
    pub tuned: Option<Tuned>,
    /// The graphs, of which the cheapest is the first program.
    pub variants: Vec<Variant>,
    /// Graphs of the function that only offer their values.
    pub others: Vec<Graph>,
}

impl Approach {
    /// Returns a graph alone.
    fn of(variant: Variant) -> Self {
        Approach {
            tuned: None,
            variants: vec![variant],
            others: Vec::new(),
        }
    }
}

/// The problem that a search is to solve.
#[derive(Clone, Copy)]
pub(crate) struct Problem<'a> {
    pub scene_robot: &'a SceneRobot,
    pub function: Function,
    pub effort: Effort,
    /// The source that is left out, to see what it earns.
    pub without: Option<WaySource>,
    /// What a program may be off, if there is a limit.
    pub limit: Option<Limit<'a>>,
    /// Regroupings to start from, besides those that every robot has.
    pub from: &'a [Regrouping<Exact>],
    pub watch: Option<FunctionWatch<'a>>,
}
