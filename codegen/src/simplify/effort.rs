//! How much work a search may do: counted in e-nodes, pairs and moves, never
//! in time, so the result is the same on every machine.

use super::extract::Schedule;
use super::rules::RuleLimits;
use super::search::SearchLimits;
use crate::words::words;

/// A program of at most so many operations is a small one.
const SMALL: usize = 100;

words! {
    /// The levels of the command line and the macro.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
    pub enum Effort: "effort" {
        /// Well below a second for a six-joint arm, in a release build.
        #[default]
        Quick = "quick",
        /// Up to two minutes a function.
        Thorough = "thorough",
    }
}

impl Effort {
    /// Rounds of the regrouping's descent.
    pub fn regrouping_rounds(self) -> usize {
        match self {
            Effort::Quick => 1,
            Effort::Thorough => 3,
        }
    }

    /// Returns the limits of the rules before the first round.
    pub(super) fn rules(self) -> RuleLimits {
        RuleLimits {
            growth: 20,
            iterations: match self {
                Effort::Quick => 2,
                Effort::Thorough => 4,
            },
        }
    }

    /// Returns the schedule for annealing what the e-graph found.
    pub(super) fn first_schedule(self) -> Schedule {
        Schedule {
            moves: match self {
                Effort::Quick => 0,
                Effort::Thorough => 500_000,
            },
            ..Schedule::COOLING
        }
    }

    /// Returns the rounds for a program of so many operations. A small one gets many short
    /// rounds: a SCARA's torques need some without any gain to come from 71 to 62,
    /// and a long round finds no more in them.
    pub(super) fn search(self, operations: usize) -> SearchLimits {
        match self {
            Effort::Quick if operations <= SMALL => SearchLimits {
                rounds: 30,
                patience: 8,
                pairs: 500,
                substitutes: 700,
                rules: RuleLimits::ROUND,
                without: None,
                schedule: Schedule {
                    moves: 10_000,
                    ..Schedule::COOLING
                },
            },
            Effort::Quick => SearchLimits {
                rounds: 3,
                patience: 1,
                pairs: 500,
                substitutes: 700,
                rules: RuleLimits::ROUND,
                without: None,
                schedule: Schedule {
                    moves: 40_000,
                    ..Schedule::COOLING
                },
            },
            Effort::Thorough => SearchLimits {
                rounds: 30,
                patience: 8,
                pairs: 2_500,
                substitutes: 3_000,
                rules: RuleLimits::ROUND,
                without: None,
                schedule: Schedule {
                    moves: 150_000,
                    ..Schedule::COOLING
                },
            },
        }
    }
}
