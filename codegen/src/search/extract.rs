//! Extraction: one way for each class that the outputs need, at the least cost of the whole graph.
//!
//! Shared work is paid once, so the cheapest tree for each class makes a shared program worse. The
//! search starts from the program that came in and keeps the best that it meets. A move gives one
//! class another way, unless that closes a circle; reference counts give the change in cost.

use std::collections::BTreeMap;

use super::egraph::{Choice, Classes, Way};
use super::order::Order;
use super::{SINCOS, price_of};
use crate::dag::Node;
use crate::random::Random;

/// The moves of an annealing and its temperatures, in additions.
#[derive(Clone, Copy, Debug)]
pub struct Schedule {
    moves: usize,
    hot: f64,
    cold: f64,
}

impl Schedule {
    /// Creates a schedule of so many moves. Hotter than this destroys a program of 300 operations.
    pub const fn cool(moves: usize) -> Schedule {
        let (hot, cold) = (0.2, 0.04);
        Schedule { moves, hot, cold }
    }

    pub(super) const fn hot(moves: usize) -> Schedule {
        let (hot, cold) = (1.0, 0.1);
        Schedule { moves, hot, cold }
    }
}

/// Nothing: what leaves read.
const NOTHING: u32 = 0;
const NONE: u32 = u32::MAX;

/// Leaves have a way that costs nothing; sines read their angle, which costs their evaluation.
#[derive(Clone, Copy)]
struct ClassStep {
    cost: u64,
    reads: [u32; 2],
    way: Option<Way>,
}

pub(super) struct Extraction<'a> {
    classes: &'a Classes,
    steps: Vec<ClassStep>,
    starts: Vec<u32>,
    outputs: Vec<u32>,
    /// The chosen way of each class, an index into `steps`.
    chosen: Vec<u32>,
    uses: Vec<u32>,
    live: Vec<u32>,
    place: Vec<u32>,
    pub(super) cost: u64,
    /// Each class after what its chosen way reads.
    order: Order,
}

impl<'a> Extraction<'a> {
    /// Starts from a choice without circles that is complete below the outputs.
    pub(super) fn new(classes: &'a Classes, seed: &Choice) -> Self {
        let ids = classes.ids();
        let mut places = vec![NONE; classes.bound()];
        let step = |cost, reads, way| ClassStep { cost, reads, way };
        // Nothing, the classes, then the angles.
        let mut ways: Vec<Vec<ClassStep>> = vec![Vec::new(); 1 + ids.len()];
        let mut angles = BTreeMap::new();
        for (place, &id) in (1usize..).zip(ids) {
            places[usize::from(id)] = place as u32;
            let Some(leaf) = classes.leaf(id) else {
                continue;
            };
            let mut reads = [NOTHING; 2];
            if let Node::Input(input) = leaf
                && let Some(angle) = input.angle()
            {
                let place = angles.entry(angle).or_insert_with(|| {
                    ways.push(vec![step(SINCOS, [NOTHING; 2], None)]);
                    ways.len() as u32 - 1
                });
                reads = [*place; 2];
            }
            ways[place].push(step(0, reads, None));
        }
        let count = ways.len();
        for (class, way) in classes.ways() {
            let reads = way.1.map(|id| places[usize::from(id)]);
            let place = places[usize::from(class)] as usize;
            ways[place].push(step(price_of(way.0), reads, Some(way)));
        }
        let mut starts = vec![0u32];
        for steps in &ways {
            starts.push(starts[starts.len() - 1] + steps.len() as u32);
        }
        let outputs = classes.outputs.iter().flatten();
        let mut search = Extraction {
            classes,
            steps: ways.concat(),
            starts,
            outputs: outputs.map(|(id, _)| places[usize::from(*id)]).collect(),
            chosen: vec![NONE; count],
            uses: vec![0; count],
            live: Vec::new(),
            place: vec![NONE; count],
            cost: 0,
            order: Order::new(count),
        };
        search.uses[NOTHING as usize] = 1;
        search.seed(seed, &places);
        search.sort();
        search.revive();
        search
    }

    fn seed(&mut self, seed: &Choice, places: &[u32]) {
        for (&place, way) in places.iter().zip(seed) {
            if place != NONE && way.is_some() {
                let is_it = |&at: &u32| self.steps[at as usize].way == *way;
                self.chosen[place as usize] = self.ways(place).find(is_it).unwrap_or(NONE);
            }
        }
        let mut changed = true;
        while std::mem::take(&mut changed) {
            for id in 1..self.chosen.len() as u32 {
                if self.chosen[id as usize] == NONE
                    && let Some(way) = self.ways(id).find(|&way| self.is_ready(way))
                {
                    self.chosen[id as usize] = way;
                    changed = true;
                }
            }
        }
    }

    fn ways(&self, id: u32) -> std::ops::Range<u32> {
        self.starts[id as usize]..self.starts[id as usize + 1]
    }

    fn is_ready(&self, way: u32) -> bool {
        let is_ready = |&id: &u32| id == NOTHING || self.chosen[id as usize] != NONE;
        self.steps[way as usize].reads.iter().all(is_ready)
    }

    fn reads(steps: &[ClassStep], chosen: &[u32], id: u32) -> [u32; 2] {
        let step = steps.get(chosen[id as usize] as usize);
        step.map_or([NOTHING; 2], |step| step.reads)
    }

    fn sort(&mut self) {
        let (steps, chosen) = (&self.steps, &self.chosen);
        self.order.sort(|id| Self::reads(steps, chosen, id));
    }

    /// True if a class may take a way: nothing that it reads depends on the class.
    fn admits(&mut self, id: u32, way: u32) -> bool {
        let (steps, chosen) = (&self.steps, &self.chosen);
        let reads = |id| Self::reads(steps, chosen, id);
        self.order.admits(id, steps[way as usize].reads, reads)
    }

    fn revive(&mut self) {
        for at in 0..self.outputs.len() {
            self.acquire(self.outputs[at]);
        }
    }

    /// A class that comes to life has the way that it had last.
    fn acquire(&mut self, id: u32) {
        self.uses[id as usize] += 1;
        if self.uses[id as usize] > 1 {
            return;
        }
        if let Some(&step) = self.steps.get(self.chosen[id as usize] as usize) {
            self.cost += step.cost;
            if self.ways(id).len() > 1 {
                self.place[id as usize] = self.live.len() as u32;
                self.live.push(id);
            }
            step.reads.into_iter().for_each(|read| self.acquire(read));
        }
    }

    /// An unused class frees what it reads.
    fn release(&mut self, id: u32) {
        self.uses[id as usize] -= 1;
        if self.uses[id as usize] > 0 {
            return;
        }
        if let Some(&step) = self.steps.get(self.chosen[id as usize] as usize) {
            self.cost -= step.cost;
            if self.ways(id).len() > 1 {
                let place = self.place[id as usize] as usize;
                self.live.swap_remove(place);
                if let Some(&moved) = self.live.get(place) {
                    self.place[moved as usize] = place as u32;
                }
            }
            step.reads.into_iter().for_each(|read| self.release(read));
        }
    }

    fn switch(&mut self, id: u32, way: u32) -> bool {
        if !self.is_ready(way) || !self.admits(id, way) {
            return false;
        }
        let old = self.steps[self.chosen[id as usize] as usize];
        let new = self.steps[way as usize];
        self.cost -= old.cost;
        old.reads.into_iter().for_each(|read| self.release(read));
        self.chosen[id as usize] = way;
        self.cost += new.cost;
        new.reads.into_iter().for_each(|read| self.acquire(read));
        true
    }

    pub(super) fn climb(&mut self) {
        loop {
            let before = self.cost;
            let mut live = self.live.clone();
            live.sort_unstable();
            for id in live {
                for way in self.ways(id) {
                    let (cost, now) = (self.cost, self.chosen[id as usize]);
                    let has_switched =
                        self.uses[id as usize] > 0 && way != now && self.switch(id, way);
                    if has_switched && self.cost >= cost {
                        self.switch(id, now);
                    }
                }
            }
            if self.cost >= before {
                return;
            }
        }
    }

    pub(super) fn anneal(&mut self, schedule: Schedule, random: &mut Random) {
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
            let way = self.starts[id as usize] + random.below(self.ways(id).len()) as u32;
            let (before, now) = (self.cost, self.chosen[id as usize]);
            if way == now || !self.switch(id, way) {
                continue;
            }
            let rise = self.cost as f64 - before as f64;
            if rise > 0.0 && random.unit() >= libm::exp(-rise / temperature) {
                self.switch(id, now);
            } else if self.cost < best.0 || (self.cost == best.0 && step % 64 == 0) {
                // Now and then an equal program replaces the best: the next round starts from there.
                best.0 = self.cost;
                best.1.clone_from(&self.chosen);
            }
        }
        for at in 0..self.outputs.len() {
            self.release(self.outputs[at]);
        }
        self.chosen = best.1;
        self.sort();
        self.revive();
    }

    pub(super) fn choice(&self) -> Choice {
        let mut choice: Choice = vec![None; self.classes.bound()];
        for (at, &id) in self.classes.ids().iter().enumerate() {
            let step = self.steps.get(self.chosen[at + 1] as usize);
            choice[usize::from(id)] = step.and_then(|step| step.way);
        }
        choice
    }
}
