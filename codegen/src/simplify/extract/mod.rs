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

use super::classes::{Choice, ClassId, Classes, Leaf, Way};
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
    /// The place of each class, by its id.
    places: Vec<Place>,
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
        let mut places = vec![NONE; classes.bound()];
        for (place, &id) in classes.ids().iter().enumerate() {
            places[usize::from(id)] = place as Place;
        }
        let place = |id: ClassId| places[usize::from(id)];
        let mut starts = vec![0; classes.ids().len() + 1];
        for (id, _) in classes.ways() {
            starts[place(id) as usize + 1] += 1;
        }
        for place in 1..starts.len() {
            starts[place] += starts[place - 1];
        }
        let mut ends = starts.clone();
        let mut ways = vec![None; starts.last().map_or(0, |&end| end as usize)];
        for (id, way) in classes.ways() {
            let end = &mut ends[place(id) as usize];
            ways[*end as usize] = Some(way);
            *end += 1;
        }
        let ways: Vec<Way> = ways.into_iter().flatten().collect();
        let step = |way: &Way| Step {
            cost: model.way(way.operator),
            operands: way.operands.map(place),
        };
        let steps = ways.iter().map(step).collect();
        Ways {
            steps,
            ways,
            starts,
            places,
        }
    }

    /// The range of a class in both lists.
    fn range(&self, id: Place) -> std::ops::Range<usize> {
        self.starts[id as usize] as usize..self.starts[id as usize + 1] as usize
    }

    /// The ways of a class.
    fn of(&self, id: Place) -> &[Step] {
        &self.steps[self.range(id)]
    }

    /// Returns what the chosen way of a class reads.
    fn operands(&self, chosen: &[u32], id: Place) -> Option<[Place; 2]> {
        let step = self.of(id).get(chosen[id as usize] as usize)?;
        Some(step.operands)
    }
}

impl<'a> Extraction<'a> {
    /// Starts from a choice that is acyclic and complete below the outputs;
    /// every other class gets an acyclic way where it has one.
    pub(crate) fn new(classes: &'a Classes, seed: &[Option<Way>], model: CostModel) -> Self {
        let n = classes.ids().len();
        let mut is_leaf = vec![false; n];
        let mut angles: BTreeMap<AngleSum, u32> = BTreeMap::new();
        let mut angle_of = vec![NONE; n];
        let mut angle_cost = Vec::new();
        for (place, &id) in classes.ids().iter().enumerate() {
            let leaf = classes.leaf(id);
            is_leaf[place] = leaf.is_some();
            if let Some(Leaf::Input(input)) = leaf
                && let Some(angle) = input.angle()
            {
                let next = angles.len() as u32;
                angle_of[place] = *angles.entry(angle).or_insert_with(|| {
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
            search.acquire(search.ways.places[usize::from(output.class)], 0);
        }
        search.undo.clear();
        search
    }

    /// Adds the seed's ways, then, class by class until nothing changes, ways whose operands are
    /// computable: acyclic, since each uses earlier ones.
    fn seed(&mut self, seed: &[Option<Way>]) {
        for (place, &id) in self.classes.ids().iter().enumerate() {
            if let Some(Some(way)) = seed.get(usize::from(id)) {
                let ways = &self.ways.ways[self.ways.range(place as Place)];
                let index = ways.iter().position(|own| own == way);
                self.chosen[place] = index.map_or(NONE, |index| index as u32);
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

    /// Returns the chosen ways.
    pub(crate) fn choice(&self) -> Choice {
        let mut choice = vec![None; self.classes.bound()];
        for (place, &id) in self.classes.ids().iter().enumerate() {
            let ways = &self.ways.ways[self.ways.range(place as Place)];
            choice[usize::from(id)] = ways.get(self.chosen[place] as usize).copied();
        }
        choice
    }

    fn way(&self, id: Place) -> Option<Step> {
        let chosen = self.chosen[id as usize];
        self.ways.of(id).get(chosen as usize).copied()
    }

    /// Takes a whole choice.
    fn restore(&mut self, chosen: &[u32]) {
        for output in self.classes.outputs.iter().flatten() {
            self.release(self.ways.places[usize::from(output.class)]);
        }
        self.chosen.copy_from_slice(chosen);
        let (ways, chosen) = (&self.ways, &self.chosen);
        self.order.sort(|id| ways.operands(chosen, id));
        for output in self.classes.outputs.iter().flatten() {
            self.acquire(self.ways.places[usize::from(output.class)], 0);
        }
        self.undo.clear();
    }
}
