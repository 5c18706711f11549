//! What a function's search starts from: a file a start.
//!
//! - `auto`: the cheapest, with the others' values at hand
//! - `angle_sums`: the same, where sines of sums of angles may be evaluated
//! - `only`: a textbook formulation alone
//!
//! Command, macro, plans and searches ask here; none of them knows a start by name. To
//! add one: write its file, and add its line to the list below.

mod angle_sums;
mod auto;
mod only;

use dalembert_model::equations::Formulation;
use dalembert_model::equations::chain::Regrouping;
use dalembert_model::number::Exact;

use super::{Limit, Variant, tune::Tuned};
use crate::function::Function;
use crate::graph::Graph;
use crate::scene::SceneRobot;
use crate::simplify::{Effort, WaySource};
use crate::watch::FunctionWatch;
use crate::words::Word;
use only::Only;
pub(super) use only::TEXTBOOK;

/// What a start's file says.
trait Beginning {
    /// Returns its name on the command line, in the macro and in plans.
    fn name(&self) -> &'static str;

    /// Returns what to search from, each by itself: the cheapest that is found is taken.
    fn approaches(&self, problem: &Problem<'_>) -> Vec<Approach>;

    /// Values that no formula forms but that may shorten it.
    fn helpers(&self, _: &SceneRobot) -> Vec<Graph> {
        Vec::new()
    }

    /// Returns whether it has the chain formulas: a load is numbers of these.
    fn has_chain(&self) -> bool {
        false
    }

    /// Returns whether a tolerance may be met in another regrouping than that which is
    /// cheapest without one.
    fn may_regroup(&self) -> bool {
        false
    }
}

/// A line a start: its documentation, its file, its name in Rust.
macro_rules! starts {
    ($($(#[$doc:meta])* $file:ident: $start:ident,)*) => {
        /// Which formulation a function starts from.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
        #[non_exhaustive]
        pub enum Start {
            $($(#[$doc])* $start,)*
            /// One textbook formulation only.
            Only(Formulation),
        }

        impl Start {
            /// Returns the choices of the command line and the macro.
            pub fn all() -> impl Iterator<Item = Start> {
                let textbook = TEXTBOOK.into_iter().map(Start::Only);
                [$(Start::$start),*].into_iter().chain(textbook)
            }

            fn beginning(self) -> Box<dyn Beginning> {
                match self {
                    $(Start::$start => Box::new($file::$start),)*
                    Start::Only(formulation) => Box::new(Only(formulation)),
                }
            }
        }
    };
}

starts! {
    /// The cheapest, with the others' values at hand.
    #[default]
    auto: Auto,
    /// As [`Start::Auto`], where the sines and cosines of angle sums of
    /// parallel joints may be evaluated instead of formed: fewer operations,
    /// a pair more, and an error of |q| u in the sum.
    angle_sums: AngleSums,
}

impl Start {
    /// Returns its name.
    pub fn name(self) -> &'static str {
        self.beginning().name()
    }

    /// Returns whether functions that it starts can take a load.
    pub fn has_chain(self) -> bool {
        self.beginning().has_chain()
    }

    /// Returns whether a tolerance may be met in another regrouping than that which is
    /// cheapest without one.
    pub fn may_regroup(self) -> bool {
        self.beginning().may_regroup()
    }

    /// Values that no formula forms but that may shorten it.
    pub(crate) fn helpers(self, scene_robot: &SceneRobot) -> Vec<Graph> {
        self.beginning().helpers(scene_robot)
    }

    /// Returns what to search from, each by itself: the cheapest that is found is taken.
    pub(crate) fn approaches(self, problem: &Problem<'_>) -> Vec<Approach> {
        self.beginning().approaches(problem)
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
