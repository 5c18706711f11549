//! Rounds counted, for who watches.

use std::cell::Cell;

use super::Target;
use crate::bound::work::Meter;
use crate::program::Program;
use crate::watch::{FunctionWatch, Part};

pub(super) struct Tally<'a> {
    watch: FunctionWatch<'a>,
    done: Cell<usize>,
    rounds: usize,
    meter: Meter,
}

impl<'a> Tally<'a> {
    pub(super) fn new(target: &Target<'a>) -> Tally<'a> {
        let (settings, steps) = (target.settings, target.steps());
        Tally {
            watch: target.watch,
            done: Cell::new(0),
            rounds: (0..settings.stages)
                .map(|stage| settings.guesses(stage, steps) + settings.retries(stage))
                .sum(),
            meter: Meter::new(settings.work),
        }
    }

    pub(super) fn round(&self, best: &Program) {
        let done = self.done.get();
        let rounds = [done, self.rounds.max(done + 1)];
        self.watch
            .step(Part::Omissions, rounds, Some(best.counts()));
        self.done.set(done + 1);
    }

    pub(super) fn is_over(&self) -> bool {
        self.meter.is_over() || self.watch.is_over()
    }
}
