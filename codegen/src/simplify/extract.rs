//! Extraction: one way for each needed class, at the least cost of the DAG.
//!
//! Shared work is paid once, so choosing the cheapest tree for each class
//! makes a shared program worse. The search starts from the program that came
//! in and keeps the best it has seen, so it is never worse than that. A move
//! gives one class another way; reference counts give the change in cost, and
//! a move that would close a cycle is refused.

use std::collections::BTreeMap;

use super::classes::{ClassId, Classes, ENode, Leaf};
use super::order::Order;
use crate::program::AngleSum;
use crate::random::Random;

/// What operations cost, in hundredths of an operation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CostModel {
    /// A multiplication.
    pub mul: u64,
    /// An addition.
    pub add: u64,
    /// A division.
    pub div: u64,
    /// A sine/cosine pair of a joint's angle.
    pub sincos: u64,
    /// A sine/cosine pair of a sum of angles, where it is to be had at all.
    pub sum_sincos: u64,
}

impl CostModel {
    /// Fewest operations; of equal sums the one with fewer multiplications;
    /// an angle costs as much as twenty operations, a division as five. The pair of a sum is to be
    /// had only if somebody asked for it, and then costs a little less than the
    /// six operations that form it from other pairs.
    pub const OPERATIONS: CostModel = CostModel {
        mul: 101,
        add: 100,
        div: 500,
        sincos: 2000,
        sum_sincos: 300,
    };

    /// The sine and cosine of an angle, apart from forming it.
    pub fn angle(&self, angle: AngleSum) -> u64 {
        match angle.additions() {
            0 => self.sincos,
            _ => self.sum_sincos,
        }
    }

    /// The cheapest operation.
    fn least(&self) -> u64 {
        self.mul.min(self.add).min(self.div)
    }

    fn way(&self, way: ENode) -> u64 {
        match way {
            ENode::Product(..) => self.mul,
            ENode::Sum(..) | ENode::Difference(..) => self.add,
            ENode::Quotient(..) => self.div,
        }
    }
}

/// How long to anneal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Schedule {
    /// Moves tried.
    pub moves: usize,
    /// First temperature, in operations.
    pub hot: f64,
    /// Last temperature, in operations.
    pub cold: f64,
}

impl Schedule {
    /// No moves yet. Hotter than this destroys a program of 300 operations.
    pub(super) const COOLING: Schedule = Schedule {
        moves: 0,
        hot: 0.2,
        cold: 0.04,
    };
}

/// The state of the search.
pub struct Extraction<'a> {
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

/// What the chosen way of a class reads.
fn operands(classes: &Classes, chosen: &[u32], id: ClassId) -> Option<[ClassId; 2]> {
    let ways = &classes.get(id).ways;
    Some(ways.get(chosen[id as usize] as usize)?.operands())
}

/// The ways of a dead operand that are looked at: the first found, which are
/// those of real programs.
const MAX_ENODES: usize = 16;

impl<'a> Extraction<'a> {
    /// Starts from a choice that is acyclic and complete below the outputs;
    /// every other class gets an acyclic way where it has one.
    pub fn new(classes: &'a Classes, seed: &[Option<ENode>], model: CostModel) -> Self {
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

    /// The seed's ways, then, class by class until nothing changes, ways
    /// whose operands are computable: acyclic, since each uses earlier ones.
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
    pub fn cost(&self) -> u64 {
        self.cost
    }

    /// The chosen ways.
    pub fn choice(&self) -> Vec<Option<ENode>> {
        (0..self.classes.len() as ClassId)
            .map(|id| self.way(id))
            .collect()
    }

    /// The classes that the live program computes, ascending.
    pub fn live(&self) -> Vec<ClassId> {
        let mut live = self.live.clone();
        live.sort_unstable();
        live
    }

    fn way(&self, id: ClassId) -> Option<ENode> {
        let chosen = self.chosen[id as usize];
        self.classes.get(id).ways.get(chosen as usize).copied()
    }

    /// One more use; a class that comes to life takes the way that adds least.
    fn acquire(&mut self, id: ClassId, depth: u32) {
        self.uses[id as usize] += 1;
        if self.uses[id as usize] > 1 {
            return;
        }
        let angle = self.angle_of[id as usize];
        if angle != NONE {
            self.angle_uses[angle as usize] += 1;
            if self.angle_uses[angle as usize] == 1 {
                self.cost += self.angle_cost[angle as usize];
            }
        }
        if depth > 0 {
            self.choose_for_birth(id);
        }
        if let Some(way) = self.way(id) {
            self.cost += self.model.way(way);
            self.place[id as usize] = self.live.len() as u32;
            self.live.push(id);
            for operand in way.operands() {
                self.acquire(operand, depth);
            }
        }
    }

    /// One use less; an unused class frees its operands.
    fn release(&mut self, id: ClassId) {
        self.uses[id as usize] -= 1;
        if self.uses[id as usize] > 0 {
            return;
        }
        let angle = self.angle_of[id as usize];
        if angle != NONE {
            self.angle_uses[angle as usize] -= 1;
            if self.angle_uses[angle as usize] == 0 {
                self.cost -= self.angle_cost[angle as usize];
            }
        }
        if let Some(way) = self.way(id) {
            self.cost -= self.model.way(way);
            let place = self.place[id as usize] as usize;
            self.live.swap_remove(place);
            if let Some(&moved) = self.live.get(place) {
                self.place[moved as usize] = place as u32;
            }
            for operand in way.operands() {
                self.release(operand);
            }
        }
    }

    /// Gives a dead class the way with the least work that is not done yet.
    fn choose_for_birth(&mut self, id: ClassId) {
        let ways = &self.classes.get(id).ways;
        if ways.len() < 2 {
            return;
        }
        let mut best = (u64::MAX, self.chosen[id as usize]);
        for (index, &way) in ways.iter().enumerate() {
            let cost = self.marginal(way, 2, best.0);
            if cost < best.0 && (index as u32 == self.chosen[id as usize] || self.admits(id, way)) {
                best = (cost, index as u32);
            }
        }
        if best.1 != self.chosen[id as usize] {
            self.undo.push((id, self.chosen[id as usize]));
            self.chosen[id as usize] = best.1;
        }
    }

    /// What a way adds, looking `depth` levels into dead operands, where that is less
    /// than `below`; else something that is not.
    fn marginal(&self, way: ENode, depth: u32, below: u64) -> u64 {
        let mut cost = self.model.way(way);
        for operand in way.operands() {
            if cost >= below {
                break;
            }
            if self.uses[operand as usize] > 0 {
                continue;
            }
            let angle = self.angle_of[operand as usize];
            if angle != NONE && self.angle_uses[angle as usize] == 0 {
                cost += self.angle_cost[angle as usize];
            }
            let class = self.classes.get(operand);
            if class.leaf.is_some() {
                continue;
            }
            if depth == 0 {
                cost += 2 * self.model.add;
                continue;
            }
            let mut least = u64::MAX / 4;
            for &way in class.ways.iter().take(MAX_ENODES) {
                // No way costs less than one operation.
                let one = self.model.least();
                if least <= one || cost + one >= below {
                    break;
                }
                let room = least.min(below - cost);
                least = least.min(self.marginal(way, depth - 1, room));
            }
            cost += least;
        }
        cost
    }

    /// Whether the class may take the way: no operand of it depends on the class.
    fn admits(&mut self, id: ClassId, way: ENode) -> bool {
        let (classes, chosen) = (self.classes, &self.chosen);
        self.order
            .admits(id, way.operands(), |id| operands(classes, chosen, id))
    }

    /// Whether every operand has a way or is a leaf.
    fn computable(&self, way: ENode) -> bool {
        way.operands()
            .iter()
            .all(|&id| self.classes.get(id).leaf.is_some() || self.chosen[id as usize] != NONE)
    }

    /// Gives a live class another way; `None` if that closes a cycle.
    /// The caller may take it back with [`Self::revert`].
    fn switch(&mut self, id: ClassId, index: u32) -> Option<()> {
        let old = self.way(id)?;
        let new = *self.classes.get(id).ways.get(index as usize)?;
        if !self.computable(new) || !self.admits(id, new) {
            return None;
        }
        self.undo.clear();
        self.undo.push((id, self.chosen[id as usize]));
        self.rewire(id, old, index, new, 1);
        Some(())
    }

    fn rewire(&mut self, id: ClassId, old: ENode, index: u32, new: ENode, depth: u32) {
        // The old operands go first, so that what only they kept alive counts
        // as work for the new way.
        self.cost -= self.model.way(old);
        for operand in old.operands() {
            self.release(operand);
        }
        self.chosen[id as usize] = index;
        self.cost += self.model.way(new);
        for operand in new.operands() {
            self.acquire(operand, depth);
        }
    }

    fn revert(&mut self) {
        let Some(&(id, index)) = self.undo.first() else {
            return;
        };
        let Some(now) = self.way(id) else {
            return;
        };
        let Some(&before) = self.classes.get(id).ways.get(index as usize) else {
            return;
        };
        // Kill what the move brought to life, restore the choices it made
        // there, then revive the old operands with the choices they had.
        self.cost -= self.model.way(now);
        for operand in now.operands() {
            self.release(operand);
        }
        while let Some((id, index)) = self.undo.pop() {
            self.chosen[id as usize] = index;
            // As before the move, each in turn: no cycle, but another order.
            if let Some(way) = self.way(id) {
                self.admits(id, way);
            }
        }
        self.cost += self.model.way(before);
        for operand in before.operands() {
            self.acquire(operand, 0);
        }
    }

    /// Sweeps over the live classes, taking every change that does not raise
    /// the cost, until a sweep saves nothing.
    pub fn climb(&mut self) {
        loop {
            let before = self.cost;
            let mut order = self.live.clone();
            order.sort_unstable();
            for id in order {
                for index in 0..self.classes.get(id).ways.len() as u32 {
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

    /// Annealing; ends with the best program seen.
    pub fn anneal(&mut self, schedule: Schedule, random: &mut Random) {
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
            let ways = self.classes.get(id).ways.len();
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::rules::pattern::graph;

    const MODEL: CostModel = CostModel::OPERATIONS;
    const SCHEDULE: Schedule = Schedule {
        moves: 2_000,
        hot: 2.0,
        cold: 0.05,
    };

    /// What the outputs cost by a choice, found from nothing but the choice;
    /// `None` where it goes in a circle.
    fn cost_of(classes: &Classes, choice: &[Option<ENode>]) -> Option<u64> {
        fn visit(
            classes: &Classes,
            choice: &[Option<ENode>],
            id: ClassId,
            state: &mut [u8],
        ) -> Option<u64> {
            match state[id as usize] {
                2 => return Some(0),
                1 => return None,
                _ => {}
            }
            if classes.get(id).leaf.is_some() {
                return Some(0);
            }
            state[id as usize] = 1;
            let way = choice[id as usize]?;
            let mut cost = MODEL.way(way);
            for operand in way.operands() {
                cost += visit(classes, choice, operand, state)?;
            }
            state[id as usize] = 2;
            Some(cost)
        }
        let mut state = vec![0; classes.len()];
        let outputs = classes.outputs.iter().flatten();
        let costs = outputs.map(|output| visit(classes, choice, output.class, &mut state));
        costs.sum()
    }

    /// The least cost over all choices.
    fn least(classes: &Classes) -> u64 {
        let ways: Vec<&[ENode]> = (0..classes.len() as ClassId)
            .map(|id| classes.get(id).ways.as_slice())
            .collect();
        let count: usize = ways.iter().map(|ways| ways.len().max(1)).product();
        assert!((2..100_000).contains(&count), "{count} choices");
        let cost = |mut index: usize| {
            let choice = ways.iter().map(|ways| {
                let way = ways.get(index % ways.len().max(1)).copied();
                index /= ways.len().max(1);
                way
            });
            cost_of(classes, &choice.collect::<Vec<_>>())
        };
        (0..count)
            .filter_map(cost)
            .min()
            .expect("the program that came in is one")
    }

    /// Formulas of the same values, the first ones the outputs.
    fn classes(outputs: &[&str], others: &[&str]) -> Classes {
        let mut classes = Classes::new(&graph(outputs));
        classes.absorb(&graph(others));
        classes
    }

    #[test]
    fn finds_the_cheapest_of_all_programs() {
        let cases = [
            classes(
                &["(+ (* ?a ?b) (* ?a ?c))", "(* ?d (+ ?b ?c))"],
                &["(* ?a (+ ?b ?c))", "(+ (* ?d ?b) (* ?d ?c))"],
            ),
            // Sharing decides: a·b and a·c are wanted anyway.
            classes(
                &["(* ?a (+ ?b ?c))", "(* ?a ?b)", "(* ?a ?c)"],
                &["(+ (* ?a ?b) (* ?a ?c))"],
            ),
            classes(
                &[
                    "(- (* ?a ?a) (* ?b ?b))",
                    "(+ ?a ?b)",
                    "(* (+ ?a ?b) (- ?c (+ ?a ?b)))",
                ],
                &[
                    "(* (+ ?a ?b) (- ?a ?b))",
                    "(- (* (+ ?a ?b) ?c) (* (+ ?a ?b) (+ ?a ?b)))",
                ],
            ),
        ];
        for classes in &cases {
            let program = classes.program();
            let start = cost_of(classes, &program).unwrap();
            let mut search = Extraction::new(classes, &program, MODEL);
            assert_eq!(
                search.cost(),
                start,
                "the price of the program that came in"
            );
            search.anneal(SCHEDULE, &mut Random::new(7));
            let found = search.choice();
            assert_eq!(
                cost_of(classes, &found),
                Some(search.cost()),
                "the price that it keeps"
            );
            assert_eq!(search.cost(), least(classes));
        }
    }

    #[test]
    fn a_way_in_a_circle_is_never_taken() {
        // b·c from y − a, y from a + b·c: each is a way for the other.
        let mut classes = Classes::new(&graph(&["(+ ?a (* ?b ?c))", "(* ?b ?c)"]));
        let [y, product] = [0, 1].map(|i| classes.outputs[i].unwrap().class);
        let sum = classes.get(y).ways[0];
        let a = sum
            .operands()
            .into_iter()
            .find(|&id| id != product)
            .unwrap();
        assert!(classes.add_way(product, ENode::Difference(y, a)));
        let program = classes.program();
        let mut search = Extraction::new(&classes, &program, MODEL);
        for seed in 0..20 {
            search.anneal(SCHEDULE, &mut Random::new(seed));
            assert!(cost_of(&classes, &search.choice()).is_some());
        }
        assert_eq!(search.cost(), MODEL.mul + MODEL.add);
    }

    #[test]
    fn the_same_seed_gives_the_same_program() {
        let classes = classes(
            &["(+ (+ (* ?a ?b) (* ?a ?c)) (* ?d ?d))", "(* ?d (+ ?b ?c))"],
            &["(+ (* ?a (+ ?b ?c)) (* ?d ?d))", "(+ (* ?d ?b) (* ?d ?c))"],
        );
        let program = classes.program();
        let run = || {
            let mut search = Extraction::new(&classes, &program, MODEL);
            search.anneal(SCHEDULE, &mut Random::new(11));
            search.climb();
            (search.cost(), search.choice())
        };
        assert_eq!(run(), run());
    }
}
