//! Another way for a class, and back.

use super::{Extraction, NONE, operands};
use crate::simplify::classes::{ClassId, ENode};

impl Extraction<'_> {
    /// Returns whether the class may take the way: no operand of it depends on the class.
    pub(super) fn admits(&mut self, id: ClassId, way: ENode) -> bool {
        let (classes, chosen) = (self.classes, &self.chosen);
        self.order
            .admits(id, way.operands(), |id| operands(classes, chosen, id))
    }

    /// Returns whether every operand has a way or is a leaf.
    fn computable(&self, way: ENode) -> bool {
        way.operands()
            .iter()
            .all(|&id| self.classes.get(id).leaf.is_some() || self.chosen[id as usize] != NONE)
    }

    /// Gives a live class another way; `None` if that closes a cycle.
    /// The caller may take it back with [`Self::revert`].
    pub(super) fn switch(&mut self, id: ClassId, index: u32) -> Option<()> {
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

    pub(super) fn revert(&mut self) {
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
}
