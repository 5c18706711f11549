//! Programs to edit, and how often.
//!
//! The exact program, those of smaller tolerances and those of smaller models
//! ([`reduce`](super::reduce)) are appraised. Of those that are about to leave little more than
//! the best one, each is edited; the best two of them again with other samples; and then, again
//! and again, the best two programs found so far. Long programs gain more by the first, short
//! ones by the second, which is quicker the shorter they are.

use crate::approximate::prune::{self, PruneSettings, Pruned, Target, cost};
use crate::approximate::reduce;
use crate::parallel;
use crate::program::Program;
use crate::setup::Setup;

/// Starts that are about to leave this much more than the best are not edited.
const NEAR: f64 = 1.15;

const AGAIN: usize = 2;

pub(super) struct Starts<'a> {
    pub setup: &'a Setup,
    pub target: Target<'a>,
    pub equal: Option<&'a Program>,
}

impl Starts<'_> {
    /// The cheapest comes first; it is never dearer than the first program of `from`, if that is
    /// within the allowances.
    pub(super) fn pruned(
        &self,
        from: &[Program],
        models: &mut Option<Vec<Program>>,
    ) -> Vec<Pruned> {
        let settings = self.target.settings;
        let mut starts: Vec<Option<&Program>> = vec![None];
        starts.extend(from.iter().map(Some));
        // Where nothing may go, no smaller model is near enough.
        if settings.models > 0 && self.price(None) < self.cost(None) {
            let models = models.get_or_insert_with(|| reduce::programs(self.setup, self.target));
            starts = self.promising(starts, models);
        }
        let mut found = self.started(&starts);
        if let Some(first) = from.first().filter(|first| least(&found) > cost(first)) {
            add(&mut found, prune::unedited(self.target, first));
        }
        for round in 1..=settings.rounds(least(&found)) {
            if self.target.watch.is_over() {
                break;
            }
            let best = found.iter().take(AGAIN);
            let best: Vec<Program> = best.map(|found| found.program.clone()).collect();
            add(&mut found, self.edited(best.iter().map(Some), round));
        }
        found
    }

    fn started(&self, starts: &[Option<&Program>]) -> Vec<Pruned> {
        let mut found = Vec::new();
        let edited = self.edited(starts.iter().copied(), 0);
        let mut ranked: Vec<_> = edited
            .iter()
            .map(|found| cost(&found.program))
            .zip(starts)
            .collect();
        ranked.sort_by_key(|(left, _)| *left);
        add(&mut found, edited);
        if found.is_empty() {
            return found;
        }
        let settings = self.target.settings;
        for round in 1..=settings.again(self.target.steps(), least(&found)) {
            if self.target.watch.is_over() {
                break;
            }
            let best = ranked.iter().take(AGAIN).map(|(_, start)| **start);
            add(&mut found, self.edited(best, round));
        }
        found
    }

    fn promising<'p>(
        &self,
        mut starts: Vec<Option<&'p Program>>,
        models: &'p [Program],
    ) -> Vec<Option<&'p Program>> {
        let others = starts.len();
        starts.extend(models.iter().map(Some));
        let prices = parallel::each(&starts, |start| self.price(*start));
        let mut places = Vec::from_iter(0..starts.len());
        places.sort_by_key(|&place| prices[place]);
        let most = places
            .first()
            .map_or(0.0, |&best| NEAR * prices[best] as f64);
        let mut models = 0;
        places.retain(|&place| {
            let is_model = place >= others;
            models += usize::from(is_model);
            prices[place] as f64 <= most && !(is_model && models > self.target.settings.models)
        });
        let mut starts: Vec<_> = places.into_iter().map(|place| starts[place]).collect();
        starts.sort_by_key(|start| self.cost(*start));
        starts
    }

    fn program<'p>(&'p self, start: Option<&'p Program>) -> &'p Program {
        start.or(self.equal).unwrap_or(self.target.exact)
    }

    fn cost(&self, start: Option<&Program>) -> usize {
        cost(self.program(start))
    }

    fn price(&self, start: Option<&Program>) -> usize {
        prune::appraise(self.target, self.program(start)) as usize
    }

    fn edited<'p>(
        &self,
        starts: impl Iterator<Item = Option<&'p Program>>,
        round: u64,
    ) -> Vec<Pruned> {
        let starts: Vec<_> = starts.collect();
        let settings = self.target.settings;
        let settings = PruneSettings {
            seed: settings.seed + round,
            ..*settings
        };
        let target = Target {
            settings: &settings,
            ..self.target
        };
        parallel::each(&starts, |start| prune::pruned(target, start.or(self.equal)))
    }
}

fn least(found: &[Pruned]) -> usize {
    let first = found.first();
    first.map_or(usize::MAX, |found| cost(&found.program))
}

fn add(found: &mut Vec<Pruned>, others: impl IntoIterator<Item = Pruned>) {
    for other in others {
        if !other.stages.is_empty() && found.iter().all(|known| known.program != other.program) {
            found.push(other);
        }
    }
    found.sort_by_key(|pruned| cost(&pruned.program));
}
