//! Choosing: the cheapest edits that a certificate admits.
//!
//! A greedy search ranks edits of the *emitted* program by error for each
//! operation saved, constants corrected for what is left out; parts of what
//! it chose are taken back at random and chosen anew. Errors are measured at
//! sampled positions, there as the certificate measures them. What the search
//! finds counts only if [`bound`](super::bound) certifies it. The edited
//! program is then simplified, which may save more, and edited again.
//!
//! - `search`: guesses, each certified
//! - `greedy`: the ranking
//! - `columns`: programs at many states
//! - `motions`: errors at a position, at the worst rates
//! - `fit`: constants corrected for what is left out
//! - `price`: operations that stay
//! - `omissions`: what was left out, for reports; `tally`: rounds, for who watches

mod columns;
mod fit;
mod greedy;
mod motions;
mod omissions;
mod price;
mod search;
mod tally;

use super::bound::Budget;
use super::edits::Stage;
use super::input_box::InputBox;
use crate::schedule::Program;
use crate::simplify::Effort;
use crate::simplify::random::Random;
use crate::watch::Vigil;
use motions::Motions;
pub use omissions::{Omission, omissions};
use search::Search;
use tally::Tally;

/// How hard to search, counted, never timed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Sampled positions.
    pub samples: usize,
    /// Guesses of how far sampled and certified errors are apart.
    pub guesses: usize,
    /// Times that a part is taken back and chosen anew.
    pub retries: usize,
    /// Programs to edit one after the other.
    pub stages: usize,
    /// For the certificates that decide.
    pub budget: Budget,
    /// How much the simplifier may do between stages.
    pub effort: Effort,
    /// Whether constants are corrected for what is left out.
    pub refit: bool,
}

impl Default for Settings {
    fn default() -> Self {
        Settings {
            samples: 40,
            guesses: 4,
            retries: 12,
            stages: 2,
            budget: Budget::GLANCE,
            effort: Effort::Quick,
            refit: true,
        }
    }
}

/// A cheaper program within its tolerance.
#[derive(Clone, Debug)]
pub struct Pruned {
    /// What was edited, program after program.
    pub stages: Vec<Stage>,
    /// The program to emit: the last stage's edited program, simplified.
    pub program: Program,
    /// The certified largest |pruned − full| of each output.
    pub errors: Vec<f64>,
}

/// The cheapest variant found of which every output is certified to stay
/// within its allowance (in the output's unit) over the box.
pub fn prune(
    program: &Program,
    limits: &InputBox,
    allowances: &[f64],
    settings: &Settings,
) -> Pruned {
    watched(program, limits, allowances, settings, None)
}

/// [`prune`] under a watch: where it is over, the search ends with its best.
pub fn watched(
    program: &Program,
    limits: &InputBox,
    allowances: &[f64],
    settings: &Settings,
    watch: Option<Vigil<'_>>,
) -> Pruned {
    let tally = Tally::new(settings, watch);
    let mut best = Pruned {
        stages: Vec::new(),
        program: program.clone(),
        errors: vec![0.0; program.outputs.len()],
    };
    let mut random = Random::new(0x9121);
    let motions = Motions::new(program, limits);
    let mut positions = motions::positions(limits, settings.samples, &mut random);
    for _ in 0..settings.stages {
        let search = Search {
            full: program,
            base: best.clone(),
            limits,
            allowances,
            settings,
            motions: &motions,
            tally: &tally,
        };
        match search.run(&mut positions, &mut random) {
            Some(found) => best = found,
            None => break,
        }
    }
    best
}
