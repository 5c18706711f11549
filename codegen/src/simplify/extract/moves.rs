//! Another way for a class, and back.

use super::{Extraction, NONE, Place, Step};

impl Extraction<'_> {
    /// Returns whether the class may take the way: no operand of it depends on the class.
    pub(super) fn admits(&mut self, id: Place, way: Step) -> bool {
        let (ways, chosen) = (&self.ways, &self.chosen);
        let operands = |id| ways.operands(chosen, id);
        self.order.admits(id, way.operands, operands)
    }

    /// Returns whether every operand has a way or is a leaf.
    fn computable(&self, way: Step) -> bool {
        let mut operands = way.operands.iter().map(|&id| id as usize);
        operands.all(|id| self.is_leaf[id] || self.chosen[id] != NONE)
    }

    /// Gives a live class another way; `None` if that closes a cycle.
    /// The caller may take it back with [`Self::revert`].
    pub(super) fn switch(&mut self, id: Place, index: u32) -> Option<()> {
        let old = self.way(id)?;
        let new = *self.ways.of(id).get(index as usize)?;
        if !self.computable(new) || !self.admits(id, new) {
            return None;
        }
        self.undo.clear();
        self.undo.push((id, self.chosen[id as usize]));
        self.rewire(id, old, index, new, 1);
        Some(())
    }

    fn rewire(&mut self, id: Place, old: Step, index: u32, new: Step, depth: u32) {
        // The old operands go first, so that what only they kept alive counts
        // as work for the new way.
        self.cost -= old.cost;
        for operand in old.operands {
            self.release(operand);
        }
        self.chosen[id as usize] = index;
        self.cost += new.cost;
        for operand in new.operands {
            self.acquire(operand, depth);
        }
    }

    pub(super) fn revert(&mut self) {
        let Some(&(id, index)) = self.undo.first() else {
            return;
        };
        let Some(now) = self.way(id) else {
            return;
        };
        let Some(&before) = self.ways.of(id).get(index as usize) else {
            return;
        };
        // Kill what the move brought to life, restore the choices it made
        // there, then revive the old operands with the choices they had.
        self.cost -= now.cost;
        for operand in now.operands {
            self.release(operand);
        }
        while let Some((id, index)) = self.undo.pop() {
            self.chosen[id as usize] = index;
            // As before the move, each in turn: no cycle, but another order.
            if let Some(way) = self.way(id) {
                self.admits(id, way);
            }
        }
        self.cost += before.cost;
        for operand in before.operands {
            self.acquire(operand, 0);
        }
    }
}
