//! Choosing: the cheapest edits that a certificate admits.
//!
//! A greedy search ranks edits of the *emitted* program by error for each operation saved,
//! constants corrected for what is left out; parts of what it chose are taken back at random and
//! chosen anew. Errors are measured at sampled positions, there as the certificate measures them.
//! A result of the search counts only if [`bound`](crate::bound::magnitude) certifies it. The edited
//! program is then simplified, which may save more, and edited again. In which regrouping the exact
//! program is matters more than how small it is there (`approximate/regrouping.rs`).
//!
//! - `search`: guesses, each certified
//! - `greedy`: the ranking
//! - `columns`: programs at many states; `side_by_side`: their operations
//! - `fit`: constants corrected for what is left out
//! - `price`: operations that stay
//! - `spares`: multiples of values that others could be replaced by
//! - `tally`: rounds, for who watches

mod columns;
mod fit;
mod greedy;
mod price;
mod search;
mod side_by_side;
mod spares;
mod tally;

use super::motions::{self, Motions};
use crate::bound::input_box::InputBox;
use crate::bound::magnitude::{BoxEffort, magnitudes_within};
use crate::edits::{Stage, deviation, has_edits};
use crate::program::Program;
use crate::random::Random;
use crate::search::Effort;
use crate::verify::exact::prove_same;
use crate::watch::FunctionWatch;
use columns::Nodes;
pub(super) use fit::dot;
use greedy::{Greedy, State};
use search::Search;
pub(crate) use search::cost;
use tally::Tally;

const SEED: u64 = 0x9121;

/// How hard to search, counted, never timed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PruneSettings {
    /// Sampled positions.
    pub samples: usize,
    /// Guesses of how far sampled and certified errors are apart.
    pub guesses: usize,
    /// Times that a part is taken back and chosen anew.
    pub retries: usize,
    /// Programs to edit one after the other. The first ones may use a part of the allowance, so
    /// that what goes in any case is gone before it gets tight.
    pub stages: usize,
    /// Other values tried in the place of each, those that run most alike.
    pub alike: usize,
    /// Rounds in which a regrouping is looked for that leaves less after pruning.
    pub sweeps: usize,
    /// For the certificates that decide.
    pub budget: BoxEffort,
    /// How much the simplifier may do between stages.
    pub effort: Effort,
    /// The last guesses whose worst positions stay among the samples.
    pub worst: usize,
    /// Smaller models to start from as well; none where work is limited, of which a thread counts
    /// its own.
    pub models: usize,
    /// Times that the best starts are edited again, with other samples, if they are left with
    /// some 300 operations, fewer times if with less; and that the best programs are, if they
    /// have 50, more often if they are shorter.
    pub restarts: u64,
    /// Added to the seed of the samples and of what is taken back.
    pub seed: u64,
    /// Units of work at most, if there is a limit: what was found by then counts.
    pub work: Option<u64>,
}

impl Default for PruneSettings {
    fn default() -> Self {
        PruneSettings::DEFAULT
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

impl PruneSettings {
    const DEFAULT: PruneSettings = PruneSettings {
        samples: 40,
        guesses: 4,
        retries: 6,
        stages: 3,
        alike: 4,
        sweeps: 0,
        budget: BoxEffort::QUICK,
        effort: Effort::Quick,
        worst: usize::MAX,
        models: 3,
        restarts: 3,
        seed: 0,
        work: None,
    };

    /// For who waits: seconds for a six-joint arm.
    pub const QUICK: PruneSettings = PruneSettings {
        samples: 24,
        retries: 0,
        alike: 2,
        models: 0,
        restarts: 0,
        ..PruneSettings::DEFAULT
    };

    /// The most that a search may take: minutes for a six-joint arm.
    pub const THOROUGH: PruneSettings = PruneSettings {
        stages: 4,
        sweeps: 2,
        effort: Effort::Thorough,
        models: 5,
        restarts: 10,
        ..PruneSettings::DEFAULT
    };

    /// Returns the settings for the effort of a command that reports on variants.
    pub fn of(effort: Effort) -> PruneSettings {
        match effort {
            // Fewer samples take less than half of the time: programs are edited more often.
            Effort::Quick => PruneSettings {
                samples: 24,
                worst: WORST,
                ..PruneSettings::DEFAULT
            },
            Effort::Thorough => PruneSettings::THOROUGH,
        }
    }

    pub(crate) fn rounds(&self, best: usize) -> u64 {
        50 * self.restarts / (best as u64).max(1)
    }

    pub(crate) fn again(&self, steps: usize, best: usize) -> u64 {
        if self.hurries(steps) {
            return 0;
        }
        let restarts = self.restarts;
        ((best as u64).saturating_mul(restarts) / 300).clamp(2.min(restarts), restarts)
    }

    fn positions(&self, steps: usize, outputs: usize) -> usize {
        let rounds = if self.hurries(steps) {
            WORST
        } else {
            self.worst
        };
        self.samples.saturating_add(rounds.saturating_mul(outputs))
    }

    fn part(&self, stage: usize) -> f64 {
        let ramp = RAMP.get(stage).filter(|_| stage + 1 < self.stages);
        ramp.copied().unwrap_or(1.0)
    }

    /// The first stages of long programs take what goes in any case: how far sampled and certified
    /// errors are apart is learned where it decides.
    fn guesses(&self, stage: usize, steps: usize) -> usize {
        match self.part(stage) < 1.0 && steps > LONG {
            true => 1,
            false => self.guesses,
        }
    }

    /// True for a program so long that a quick search of it would take minutes.
    fn hurries(&self, steps: usize) -> bool {
        self.effort == Effort::Quick && steps > LONG
    }

    /// Parts are taken back only where no later stage would find them anyway.
    fn retries(&self, stage: usize) -> usize {
        let is_last = self.part(stage) >= 1.0;
        if is_last { self.retries } else { 0 }
    }
}

/// Few where time is short: each makes every later guess slower, and old worst positions no longer
/// are the worst.
const WORST: usize = 2;

const LONG: usize = 400;

const RAMP: [f64; 2] = [0.5, 0.8];

/// Stages beyond those of the settings, as long as each leaves much of the allowances.
const MAX_MORE: usize = 3;

const WITH_SPARES: usize = 2;

const MUCH: f64 = 0.8;

fn leaves(best: &Pruned, allowances: &[f64]) -> bool {
    let mut pairs = best.errors.iter().zip(allowances);
    has_edits(&best.stages) && pairs.all(|(error, allowance)| *error <= MUCH * allowance)
}

#[derive(Clone, Copy)]
pub(crate) struct Target<'a> {
    pub exact: &'a Program,
    pub limits: &'a InputBox,
    /// The largest error of each output, in its unit.
    pub allowances: &'a [f64],
    pub settings: &'a PruneSettings,
    pub watch: FunctionWatch<'a>,
}

impl Target<'_> {
    pub(super) fn steps(&self) -> usize {
        self.exact.dag.operations().count()
    }
}

/// Returns the cheapest variant found of which every output is certified to stay
/// within its allowance (in the output's unit) over the box.
pub fn prune(
    program: &Program,
    limits: &InputBox,
    allowances: &[f64],
    settings: &PruneSettings,
) -> Pruned {
    let target = Target {
        exact: program,
        limits,
        allowances,
        settings,
        watch: FunctionWatch::default(),
    };
    pruned(target, None)
}

/// `start` is another program to edit in the exact one's place. If it is equal, the first stage has
/// no edits and leads there; if not, the result is bounded against the exact program directly, and
/// has no stages but that one.
pub(crate) fn pruned(target: Target<'_>, start: Option<&Program>) -> Pruned {
    let (program, settings) = (target.exact, target.settings);
    let is_direct = start.is_some_and(|start| prove_same(start, program).is_err());
    let tally = Tally::new(&target);
    let nothing = Pruned {
        stages: Vec::new(),
        program: program.clone(),
        errors: vec![0.0; program.dag.outputs.len()],
    };
    let mut best = match start {
        None => nothing.clone(),
        Some(start) => Pruned {
            stages: vec![Stage::unedited(program.clone())],
            program: start.clone(),
            ..nothing.clone()
        },
    };
    let mut random = Random::new(SEED + settings.seed);
    let motions = Motions::new(program, target.limits);
    let mut positions = motions::positions(target.limits, settings.samples, &mut random);
    let mut share = match is_direct {
        true => search::CLOSE,
        false => search::SHARE,
    };
    let mut edited = |best: &Pruned, stage: usize, spares: bool| {
        let part = if is_direct { 1.0 } else { settings.part(stage) };
        let allowances: Vec<f64> = target.allowances.iter().map(|a| a * part).collect();
        let mut base = best.clone();
        if spares {
            let states = motions.states(&positions);
            base.program = spares::spared(&base.program, &motions, &states);
        }
        let search = Search {
            target: Target {
                allowances: &allowances,
                ..target
            },
            base,
            paid: search::cost(&best.program),
            motions: &motions,
            tally: &tally,
            guesses: settings.guesses(stage, target.steps()),
            retries: settings.retries(stage),
            is_direct,
        };
        (search.run(&mut positions, &mut share, &mut random), part)
    };
    for stage in 0..settings.stages + MAX_MORE {
        if stage >= settings.stages && !leaves(&best, target.allowances) {
            break;
        }
        match edited(&best, stage, false) {
            (Some(found), _) => best = found,
            (None, part) if part < 1.0 => {}
            (None, _) => break,
        }
    }
    // Edits of the exact program are known by the places in it; others need not be.
    for _ in 0..if is_direct { WITH_SPARES } else { 0 } {
        match edited(&best, settings.stages, true) {
            (Some(found), _) => best = found,
            (None, _) => break,
        }
    }
    if is_direct {
        return direct(target, best).unwrap_or(nothing);
    }
    match has_edits(&best.stages) && search::cost(&best.program) < search::cost(program) {
        true => best,
        false => nothing,
    }
}

pub(crate) fn unedited(target: Target<'_>, start: &Program) -> Option<Pruned> {
    let start = Pruned {
        stages: vec![Stage::unedited(target.exact.clone())],
        program: start.clone(),
        errors: Vec::new(),
    };
    direct(target, start)
}

fn direct(target: Target<'_>, mut best: Pruned) -> Option<Pruned> {
    if search::cost(&best.program) >= search::cost(target.exact) {
        return None;
    }
    if !has_edits(&best.stages) {
        let error = deviation(target.exact, &best.program);
        let (limits, budget) = (target.limits, target.settings.budget);
        best.errors = magnitudes_within(&error, limits, target.allowances, budget)?;
    }
    best.stages.truncate(1);
    Some(best)
}

/// Errors at a few samples decide; nothing is certified.
pub(crate) fn appraise(target: Target<'_>, program: &Program) -> u32 {
    let mut random = Random::new(SEED);
    let motions = Motions::new(target.exact, target.limits);
    let positions = motions::positions(target.limits, target.settings.samples, &mut random);
    let states = motions.states(&positions);
    let truth = target.exact.in_doubles().run_at_many(&states).concat();
    let nodes = Nodes::new(program, &states);
    let (allowances, settings) = (target.allowances.to_vec(), target.settings);
    let prices = vec![1.0; allowances.len()];
    let mut greedy = Greedy::new(&nodes, &motions, &truth, allowances, prices, settings);
    let mut state = State::unedited(nodes);
    greedy.drop_all(&mut state, 0.0, &mut random);
    greedy.price(&state)
}
