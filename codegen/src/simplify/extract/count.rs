//! Uses of each class by chosen ways, and the cost of what lives.

use super::{Extraction, NONE, Place, Step};

/// The ways of a dead operand that are looked at: the first found, which are
/// those of real programs.
const MAX_ENODES: usize = 16;

impl Extraction<'_> {
    /// Counts one more use; a class that comes to life takes the way that adds least.
    pub(super) fn acquire(&mut self, id: Place, depth: u32) {
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
            self.cost += way.cost;
            self.place[id as usize] = self.live.len() as u32;
            self.live.push(id);
            for operand in way.operands {
                self.acquire(operand, depth);
            }
        }
    }

    /// Counts one use less; an unused class frees its operands.
    pub(super) fn release(&mut self, id: Place) {
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
            self.cost -= way.cost;
            let place = self.place[id as usize] as usize;
            self.live.swap_remove(place);
            if let Some(&moved) = self.live.get(place) {
                self.place[moved as usize] = place as u32;
            }
            for operand in way.operands {
                self.release(operand);
            }
        }
    }

    /// Gives a dead class the way with the least work that is not done yet.
    pub(super) fn choose_for_birth(&mut self, id: Place) {
        let range = self.ways.range(id);
        if range.len() < 2 {
            return;
        }
        let mut best = (u64::MAX, self.chosen[id as usize]);
        for (index, place) in range.enumerate() {
            let way = self.ways.steps[place];
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

    /// Returns what a way adds, looking `depth` levels into dead operands, where that is less
    /// than `below`; else something that is not.
    fn marginal(&self, way: Step, depth: u32, below: u64) -> u64 {
        let mut cost = way.cost;
        for operand in way.operands {
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
            if self.is_leaf[operand as usize] {
                continue;
            }
            if depth == 0 {
                cost += 2 * self.model.add;
                continue;
            }
            let mut least = u64::MAX / 4;
            for &way in self.ways.of(operand).iter().take(MAX_ENODES) {
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
}
