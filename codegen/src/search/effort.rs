//! The limits of a search, never in time, so that the result is the same on every machine.

use super::extract::Schedule;
use crate::words::words;

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

const SMALL: usize = 250;
const TINY: usize = 170;
/// A program of at most so many is searched for from its start more than once where time is not
/// short: the slopes of a PUMA's torques come out with 1003 to 1008 operations.
const MEDIUM: usize = 2_000;

#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// Walks from the start, by other random numbers each: the best of them counts.
    pub walks: usize,
    /// Rounds of a walk at most.
    pub rounds: usize,
    /// Rounds without a gain before a walk ends.
    pub patience: usize,
    /// The most classes that are paired, if the program's own are not more; zero pairs none.
    pub pairs: usize,
    /// The most classes among which two-operation substitutes are tried.
    pub substitutes: usize,
    /// The applications of the rules in a round.
    pub rules: usize,
    /// Annealing of rounds, in turns.
    pub schedules: [Schedule; 2],
}

impl Limits {
    pub(super) const GLANCE: Limits = Limits {
        walks: 1,
        rounds: 1,
        patience: 0,
        pairs: 500,
        substitutes: 1_000,
        rules: 0,
        schedules: [Schedule::cool(0); 2],
    };
}

impl Effort {
    /// Returns the limits for a program of so many operations. A small one gets many short rounds
    /// of a quick search: a SCARA's torques need some without any gain to come from 71 to 62, and a
    /// long round finds no more in them; the second walk of a tiny one brings the slopes of these
    /// torques from 96 to 82.
    pub fn limits(self, operations: usize) -> Limits {
        let (rounds, patience, pairs, substitutes, moves) = match self {
            Effort::Quick if operations <= SMALL => (30, 8, 600, 700, 10_000),
            Effort::Quick => (8, 2, 500, 700, 40_000),
            Effort::Thorough => (120, 25, 2_500, 3_000, 300_000),
        };
        Limits {
            walks: match self {
                Effort::Quick if operations <= TINY => 2,
                Effort::Thorough if operations <= MEDIUM => 4,
                _ => 1,
            },
            rounds,
            patience,
            pairs,
            substitutes,
            rules: 2,
            schedules: match self {
                Effort::Quick if operations <= SMALL => {
                    [Schedule::cool(moves), Schedule::hot(moves)]
                }
                _ => [Schedule::cool(moves); 2],
            },
        }
    }
}
