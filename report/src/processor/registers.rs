//! The program in a processor's registers: what has to go to the stack.
//!
//! Registers are given out in the printed order. Where all are taken, the value
//! that is read last from there on goes to the stack (Belady's rule), a constant
//! away, to be loaded again. Entries of arguments are loaded once, where they are
//! first read, and from then on are values like others: that is what rustc does.

use dalembert_codegen::workspace::program::Operation;

use super::flat::{Deed, Flat, Home, Item};
use super::target::{Target, Unit};
use super::values::merged_products;

/// What moves between registers and memory.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Traffic {
    /// Values that are loaded: arguments, arrays of sines, what was on the stack.
    pub loads: usize,
    /// Values that are put on the stack, to be read again.
    pub spills: usize,
    /// Angles that are put into an array, which a call reads.
    pub angles: usize,
    /// Instructions that load constants.
    pub constants: usize,
    /// Copies from register to register.
    pub copies: usize,
    /// The greatest number of values on the stack at once.
    pub slots: usize,
    /// The greatest number of registers in use.
    pub registers: usize,
    /// The greatest number of values that stay in registers over a call.
    pub over_calls: usize,
    /// Products that are one instruction with the sum that they are in.
    pub merged: usize,
}

/// Where a value is.
#[derive(Clone, Copy, Default)]
struct Location {
    register: bool,
    slot: bool,
    /// Whether it is in a register that calls keep.
    kept: bool,
}

/// The walk through the program.
struct Walk<'a> {
    flat: &'a Flat,
    target: &'a Target,
    unit: &'a Unit,
    uses: Vec<Vec<usize>>,
    /// For every item the product that becomes one instruction with it.
    merged: Vec<Option<usize>>,
    places: Vec<Location>,
    /// What is in registers; short, so that a search is quick.
    held: Vec<usize>,
    on_stack: usize,
    traffic: Traffic,
}

/// What a program moves on a processor.
pub fn traffic(flat: &Flat, target: &Target, unit: &Unit) -> Traffic {
    let mut walk = Walk {
        flat,
        target,
        unit,
        uses: flat.uses(),
        merged: match unit.accumulates {
            true => merged_products(flat),
            false => vec![None; flat.items.len()],
        },
        places: vec![Location::default(); flat.values.len()],
        held: Vec::new(),
        on_stack: 0,
        traffic: Traffic::default(),
    };
    for (at, item) in flat.items.iter().enumerate() {
        match item.deed {
            Deed::Call => walk.call(at, item),
            Deed::CallTogether => walk.call_together(at, item),
            Deed::Fused if unit.cycles.fma.is_none() => walk.call(at, item),
            Deed::Operation(_) | Deed::Fused | Deed::Negation | Deed::Return => {
                walk.compute(at, item)
            }
        }
    }
    walk.traffic
}

impl Walk<'_> {
    /// The next item behind this one that reads a value.
    fn next(&self, value: usize, at: usize) -> Option<usize> {
        let uses = &self.uses[value];
        let next = uses.partition_point(|&place| place <= at);
        uses.get(next).copied()
    }

    fn compute(&mut self, at: usize, item: &Item) {
        let folded = self.folded(at, item);
        for &value in &item.reads {
            if Some(value) != folded {
                self.load(value, at, &item.reads);
            }
        }
        let copied = match self.merged[at] {
            // Added to the other operand, which is written over.
            Some(product) => {
                self.traffic.merged += 1;
                let mut reads = item.reads.iter();
                reads.any(|&value| value != product && self.next(value, at).is_some())
            }
            None => self.target.overwrites && self.copies(at, item, folded),
        };
        self.traffic.copies += usize::from(copied);
        self.release(at, &item.reads);
        self.write(at, item);
    }

    /// The operand that the operation reads in memory: once, and never again.
    fn folded(&self, at: usize, item: &Item) -> Option<usize> {
        let (Deed::Operation(operation), &[left, right]) = (item.deed, &item.reads[..]) else {
            return None;
        };
        let in_memory = |value: usize| {
            let is = self.places[value];
            let loaded =
                is.register || matches!(self.flat.values[value], Home::Computed) && !is.slot;
            !loaded && self.next(value, at).is_none()
        };
        if !self.target.reads_memory || left == right {
            return None;
        }
        let other = commutes(operation).then_some(left);
        let mut operands = std::iter::once(right).chain(other);
        operands.find(|&value| in_memory(value))
    }

    /// Whether the operand that is written over is still needed.
    fn copies(&self, at: usize, item: &Item, folded: Option<usize>) -> bool {
        let dies = |value: usize| Some(value) != folded && self.next(value, at).is_none();
        match (item.deed, &item.reads[..]) {
            (Deed::Operation(operation), &[left, right]) => {
                let written = dies(left) || (commutes(operation) && dies(right));
                !written
            }
            (Deed::Negation, &[value]) => !dies(value),
            // Any of its three operands can be written over.
            (Deed::Fused, reads) => !reads.iter().any(|&value| dies(value)),
            _ => false,
        }
    }

    /// A call of one function for an angle, which is its argument; what comes back
    /// is in registers.
    fn call(&mut self, at: usize, item: &Item) {
        for &value in &item.reads {
            if self.places[value].register {
                self.traffic.copies += 1;
            } else {
                self.traffic.loads += 1;
            }
        }
        self.release(at, &item.reads);
        self.leave(at);
        self.write(at, item);
    }

    /// A call of one for all angles: they are put into an array, those in registers
    /// first, and sines and cosines come back in two.
    fn call_together(&mut self, at: usize, item: &Item) {
        let (held, others): (Vec<usize>, Vec<usize>) = {
            let reads = item.reads.iter();
            reads.partition(|&&value| self.places[value].register)
        };
        for value in held.into_iter().chain(others) {
            self.load(value, at, &[value]);
            self.traffic.angles += 1;
            self.release(at, &[value]);
        }
        self.leave(at);
    }

    /// A call leaves but so many registers as they are.
    fn leave(&mut self, at: usize) {
        while self.held.len() > self.unit.kept {
            self.evict(at, &[]);
        }
        for index in 0..self.held.len() {
            let value = self.held[index];
            if self.next(value, at).is_some() && !self.places[value].kept {
                self.places[value].kept = true;
                self.traffic.copies += 1;
            }
        }
        self.traffic.over_calls = self.traffic.over_calls.max(self.held.len());
    }

    fn load(&mut self, value: usize, at: usize, beside: &[usize]) {
        if self.places[value].register {
            return;
        }
        match self.flat.values[value] {
            Home::Constant(constant) if self.target.short_constants && is_short(constant) => {
                self.traffic.constants += 1;
            }
            Home::Constant(_) => self.traffic.constants += self.unit.constant,
            Home::Argument | Home::Computed | Home::Array => self.traffic.loads += 1,
        }
        self.hold(value, at, beside);
    }

    fn write(&mut self, at: usize, item: &Item) {
        for &value in &item.writes {
            if self.next(value, at).is_some() {
                self.hold(value, at, &item.writes);
            }
        }
    }

    /// A value comes into a register, another beside these goes where none is free.
    fn hold(&mut self, value: usize, at: usize, beside: &[usize]) {
        if self.held.len() >= self.unit.registers {
            self.evict(at, beside);
        }
        self.held.push(value);
        self.places[value].register = true;
        self.traffic.registers = self.traffic.registers.max(self.held.len());
    }

    fn evict(&mut self, at: usize, beside: &[usize]) {
        let candidates = self.held.iter().enumerate();
        let others = candidates.filter(|(_, value)| !beside.contains(value));
        let last = others.max_by_key(|&(_, &value)| {
            // What is never read again first; of equals the older one.
            let next = self.next(value, at).unwrap_or(usize::MAX);
            (next, std::cmp::Reverse(value))
        });
        let Some((index, &value)) = last else {
            return;
        };
        self.held.swap_remove(index);
        let place = &mut self.places[value];
        (place.register, place.kept) = (false, false);
        let stays = matches!(self.flat.values[value], Home::Constant(_) | Home::Array);
        if !stays && !place.slot && self.next(value, at).is_some() {
            self.places[value].slot = true;
            self.traffic.spills += 1;
            self.on_stack += 1;
            self.traffic.slots = self.traffic.slots.max(self.on_stack);
        }
    }

    /// What is read for the last time makes room.
    fn release(&mut self, at: usize, values: &[usize]) {
        for &value in values {
            if self.next(value, at).is_some() {
                continue;
            }
            self.held.retain(|&held| held != value);
            self.places[value].register = false;
            if std::mem::take(&mut self.places[value].slot) {
                self.on_stack -= 1;
            }
        }
    }
}

fn commutes(operation: Operation) -> bool {
    matches!(operation, Operation::Add | Operation::Mul)
}

/// Whether an instruction of Arm's can hold a constant: ±n/16·2ʳ with n from 16
/// to 31 and r from −3 to 4.
pub fn is_short(constant: f64) -> bool {
    let bits = constant.to_bits();
    let exponent = (bits >> 52 & 0x7ff) as i32 - 1023;
    bits & ((1 << 48) - 1) == 0 && (-3..=4).contains(&exponent)
}
