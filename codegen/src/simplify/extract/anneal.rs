//! Climbing and annealing.

use super::Extraction;
use crate::random::Random;

/// How long to anneal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Schedule {
    /// Moves tried.
    pub moves: usize,
    /// First temperature, in operations.
    pub hot: f64,
    /// Last temperature, in operations.
    pub cold: f64,
}

impl Schedule {
    /// No moves yet. Hotter than this destroys a program of 300 operations.
    pub(in crate::simplify) const COOLING: Schedule = Schedule {
        moves: 0,
        hot: 0.2,
        cold: 0.04,
    };
}

impl Extraction<'_> {
    /// Sweeps over the live classes, taking every change that does not raise
    /// the cost, until a sweep saves nothing.
    pub(crate) fn climb(&mut self) {
        loop {
            let before = self.cost;
            let mut order = self.live.clone();
            order.sort_unstable();
            for id in order {
                for index in 0..self.ways.of(id).len() as u32 {
                    if self.uses[id as usize] == 0 || index == self.chosen[id as usize] {
                        continue;
                    }
                    let cost = self.cost;
                    if self.switch(id, index).is_some() && self.cost >= cost {
                        self.revert();
                    }
                }
            }
            if self.cost >= before {
                return;
            }
        }
    }

    /// Anneals; ends with the best program seen.
    pub(crate) fn anneal(&mut self, schedule: Schedule, random: &mut Random) {
        let mut best = (self.cost, self.chosen.clone());
        let ratio = schedule.cold / schedule.hot;
        let mut temperature = schedule.hot;
        for step in 0..schedule.moves {
            if step % 256 == 0 {
                let part = step as f64 / schedule.moves as f64;
                temperature = 100.0 * schedule.hot * libm::pow(ratio, part);
            }
            if self.live.is_empty() {
                return;
            }
            let id = self.live[random.below(self.live.len())];
            let ways = self.ways.of(id).len();
            if ways < 2 {
                continue;
            }
            let index = random.below(ways) as u32;
            if index == self.chosen[id as usize] {
                continue;
            }
            let before = self.cost;
            if self.switch(id, index).is_none() {
                continue;
            }
            let rise = self.cost as f64 - before as f64;
            if rise > 0.0 && random.unit() >= libm::exp(-rise / temperature) {
                self.revert();
            } else if self.cost < best.0 || (self.cost == best.0 && step % 64 == 0) {
                // Of equal programs now and then a later one: the next round
                // of discovery starts from there.
                best.0 = self.cost;
                best.1.clone_from(&self.chosen);
            }
        }
        self.restore(&best.1);
    }
}
