//! Extraction: one way for each needed class, at the least cost of the DAG.
//!
//! Shared work is paid once, so choosing the cheapest tree for each class
//! makes a shared program worse. The search starts from the program that came
//! in and keeps the best it has seen, so it is never worse than that. A move
//! gives one class another way; reference counts give the change in cost, and
//! a move that would close a cycle is refused.
//!
//! - `cost`: what operations cost
//! - `count`: uses of each class, and the cost of what lives
//! - `moves`: another way for a class, and back
//! - `anneal`: climbing and annealing
//! - `order`: no way in a circle

mod anneal;
mod cost;
mod count;
mod moves;
mod order;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

use super::classes::{Choice, Classes, Leaf, Way};
use crate::program::AngleSum;
pub(crate) use anneal::Schedule;
pub(crate) use cost::CostModel;
use order::Order;

/// A class by its index.
type Place = u32;

/// A way as the search reads it.
#[derive(Clone, Copy, Debug)]
struct Step {
    cost: u64,
    operands: [Place; 2],
}

/// The ways of all classes.
struct Ways {
    steps: Vec<Step>,
    ways: Vec<Way>,
    /// The first way of each class, and the end of all.
    starts: Vec<u32>,
}

/// The state of the search.
pub(crate) struct Extraction<'a> {
    classes: &'a Classes,
    model: CostModel,
    ways: Ways,
    is_leaf: Vec<bool>,
    /// The chosen way of each class: an index into its ways.
    chosen: Vec<u32>,
    /// How often each class is used by chosen ways of live classes.
    uses: Vec<u32>,
    /// Live classes with ways, in no order, and each one's place.
    live: Vec<Place>,
    place: Vec<u32>,
    /// Users of each angle's sine and cosine.
    angle_of: Vec<u32>,
    angle_uses: Vec<u32>,
    angle_cost: Vec<u64>,
    cost: u64,
    /// Each class after what its chosen way reads.
    order: Order,
    /// Choices changed by the current move, to take it back.
    undo: Vec<(Place, u32)>,
}

const NONE: u32 = u32::MAX;

impl Ways {
    fn new(classes: &Classes, model: CostModel) -> Ways {
        let mut ways = Ways {
            steps: Vec::new(),
            ways: Vec::new(),
            starts: vec![0],
        };
        for &id in classes.ids() {
            // What is no root has no ways.
            ways.starts
                .resize(usize::from(id) + 1, ways.steps.len() as u32);
            for way in classes.ways(id) {
                ways.steps.push(Step {
                    cost: model.way(way.operator),
                    operands: way.operands.map(|id| usize::from(id) as Place),
                });
                ways.ways.push(way);
            }
        }
        ways.starts
            .resize(classes.bound() + 1, ways.steps.len() as u32);
        ways
    }

    /// The range of a class in both lists.
    fn range(&self, id: Place) -> std::ops::Range<usize> {
        self.starts[id as usize] as usize..self.starts[id as usize + 1] as usize
    }

    /// The ways of a class.
    fn of(&self, id: Place) -> &[Step] {
        &self.steps[self.range(id)]
    }

    /// What the chosen way of a class reads.
    fn operands(&self, chosen: &[u32], id: Place) -> Option<[Place; 2]> {
        let step = self.of(id).get(chosen[id as usize] as usize)?;
        Some(step.operands)
    }
}

impl<'a> Extraction<'a> {
    /// Starts from a choice that is acyclic and complete below the outputs;
    /// every other class gets an acyclic way where it has one.
    pub(crate) fn new(classes: &'a Classes, seed: &[Option<Way>], model: CostModel) -> Self {
        let n = classes.bound();
        let mut is_leaf = vec![false; n];
        let mut angles: BTreeMap<AngleSum, u32> = BTreeMap::new();
        let mut angle_of = vec![NONE; n];
        let mut angle_cost = Vec::new();
        for &id in classes.ids() {
            let leaf = classes.leaf(id);
            is_leaf[usize::from(id)] = leaf.is_some();
            if let Some(Leaf::Input(input)) = leaf
                && let Some(angle) = input.angle()
            {
                let next = angles.len() as u32;
                angle_of[usize::from(id)] = *angles.entry(angle).or_insert_with(|| {
                    angle_cost.push(model.angle(angle) + model.add * angle.additions() as u64);
                    next
                });
            }
        }
        let mut search = Extraction {
            classes,
            model,
            ways: Ways::new(classes, model),
            is_leaf,
            chosen: vec![NONE; n],
            uses: vec![0; n],
            live: Vec::new(),
            place: vec![NONE; n],
            angle_of,
            angle_uses: vec![0; angle_cost.len()],
            angle_cost,
            cost: 0,
            order: Order::new(0, |_| None),
            undo: Vec::new(),
        };
        search.seed(seed);
        search.order = Order::new(n, |id| search.ways.operands(&search.chosen, id));
        for output in classes.outputs.iter().flatten() {
            search.acquire(usize::from(output.class) as Place, 0);
        }
        search.undo.clear();
        search
    }

    /// The seed's ways, then, class by class until nothing changes, ways
    /// whose operands are computable: acyclic, since each uses earlier ones.
    fn seed(&mut self, seed: &[Option<Way>]) {
        for (id, way) in seed.iter().enumerate() {
            if let Some(way) = way {
                let ways = &self.ways.ways[self.ways.range(id as Place)];
                let place = ways.iter().position(|own| own == way);
                self.chosen[id] = place.map_or(NONE, |i| i as u32);
            }
        }
        let ready = |search: &Self, id: Place| {
            search.chosen[id as usize] != NONE || search.is_leaf[id as usize]
        };
        loop {
            let mut changed = false;
            for id in 0..self.chosen.len() as Place {
                if ready(self, id) {
                    continue;
                }
                let ways = self.ways.of(id).iter();
                let mut ways = ways.map(|way| way.operands);
                let first = ways.position(|operands| operands.iter().all(|&id| ready(self, id)));
                if let Some(first) = first {
                    self.chosen[id as usize] = first as u32;
                    changed = true;
                }
            }
            if !changed {
                return;
            }
        }
    }

    /// The cost of the live program.
    #[cfg(test)]
    pub(crate) fn cost(&self) -> u64 {
        self.cost
    }

    /// The chosen ways.
    pub(crate) fn choice(&self) -> Choice {
        let chosen = self.chosen.iter().enumerate();
        let way = |(id, &chosen): (usize, &u32)| {
            let ways = &self.ways.ways[self.ways.range(id as Place)];
            ways.get(chosen as usize).copied()
        };
        chosen.map(way).collect()
    }

    fn way(&self, id: Place) -> Option<Step> {
        let chosen = self.chosen[id as usize];
        self.ways.of(id).get(chosen as usize).copied()
    }

    /// Takes a whole choice.
    fn restore(&mut self, chosen: &[u32]) {
        for output in self.classes.outputs.iter().flatten() {
            self.release(usize::from(output.class) as Place);
        }
        self.chosen.copy_from_slice(chosen);
        let (ways, chosen) = (&self.ways, &self.chosen);
        self.order.sort(|id| ways.operands(chosen, id));
        for output in self.classes.outputs.iter().flatten() {
            self.acquire(usize::from(output.class) as Place, 0);
        }
        self.undo.clear();
    }
}
