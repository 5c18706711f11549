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

use super::classes::{ClassId, Classes, ENode, Leaf};
use crate::program::AngleSum;
pub(crate) use anneal::Schedule;
pub(crate) use cost::CostModel;
use order::Order;

/// The state of the search.
pub(crate) struct Extraction<'a> {
    classes: &'a Classes,
    model: CostModel,
    /// The chosen way of each class: an index into its ways.
    chosen: Vec<u32>,
    /// How often each class is used by chosen ways of live classes.
    uses: Vec<u32>,
    /// Live classes with ways, in no order, and each one's place.
    live: Vec<ClassId>,
    place: Vec<u32>,
    /// Users of each angle's sine and cosine.
    angle_of: Vec<u32>,
    angle_uses: Vec<u32>,
    angle_cost: Vec<u64>,
    cost: u64,
    /// Each class after what its chosen way reads.
    order: Order,
    /// Choices changed by the current move, to take it back.
    undo: Vec<(ClassId, u32)>,
}

const NONE: u32 = u32::MAX;

/// Returns what the chosen way of a class reads.
fn operands(classes: &Classes, chosen: &[u32], id: ClassId) -> Option<[ClassId; 2]> {
    let ways = &classes.get(id).ways;
    Some(ways.get(chosen[id as usize] as usize)?.operands())
}

impl<'a> Extraction<'a> {
    /// Starts from a choice that is acyclic and complete below the outputs;
    /// every other class gets an acyclic way where it has one.
    pub(crate) fn new(classes: &'a Classes, seed: &[Option<ENode>], model: CostModel) -> Self {
        let n = classes.len();
        let mut angles: BTreeMap<AngleSum, u32> = BTreeMap::new();
        let mut angle_of = vec![NONE; n];
        let mut angle_cost = Vec::new();
        for (id, group) in angle_of.iter_mut().enumerate() {
            if let Some(Leaf::Input(input)) = &classes.get(id as ClassId).leaf
                && let Some(angle) = input.angle()
            {
                let next = angles.len() as u32;
                *group = *angles.entry(angle).or_insert_with(|| {
                    angle_cost.push(model.angle(angle) + model.add * angle.additions() as u64);
                    next
                });
            }
        }
        let mut search = Extraction {
            classes,
            model,
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
        search.order = Order::new(n, |id| operands(classes, &search.chosen, id));
        for output in classes.outputs.iter().flatten() {
            search.acquire(output.class, 0);
        }
        search.undo.clear();
        search
    }

    /// Adds the seed's ways, then, class by class until nothing changes, ways whose operands are
    /// computable: acyclic, since each uses earlier ones.
    fn seed(&mut self, seed: &[Option<ENode>]) {
        for (id, way) in seed.iter().enumerate() {
            if let Some(way) = way {
                let ways = &self.classes.get(id as ClassId).ways;
                self.chosen[id] = ways
                    .iter()
                    .position(|w| w == way)
                    .map_or(NONE, |i| i as u32);
            }
        }
        let ready = |search: &Self, id: ClassId| {
            search.chosen[id as usize] != NONE || search.classes.get(id).leaf.is_some()
        };
        loop {
            let mut changed = false;
            for id in 0..self.classes.len() as ClassId {
                if ready(self, id) {
                    continue;
                }
                let ways = &self.classes.get(id).ways;
                let first = ways
                    .iter()
                    .position(|way| way.operands().iter().all(|&operand| ready(self, operand)));
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
    pub(crate) fn choice(&self) -> Vec<Option<ENode>> {
        (0..self.classes.len() as ClassId)
            .map(|id| self.way(id))
            .collect()
    }

    fn way(&self, id: ClassId) -> Option<ENode> {
        let chosen = self.chosen[id as usize];
        self.classes.get(id).ways.get(chosen as usize).copied()
    }

    /// Takes a whole choice.
    fn restore(&mut self, chosen: &[u32]) {
        for output in self.classes.outputs.iter().flatten() {
            self.release(output.class);
        }
        self.chosen.copy_from_slice(chosen);
        let (classes, chosen) = (self.classes, &self.chosen);
        self.order.sort(|id| operands(classes, chosen, id));
        for output in self.classes.outputs.iter().flatten() {
            self.acquire(output.class, 0);
        }
        self.undo.clear();
    }
}
