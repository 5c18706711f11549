//! What a function takes of one processor.

use dalembert_codegen::workspace::program::ScalarType;

use super::depth;
use super::flat::{Deed, Flat, Home};
use super::registers::{Traffic, is_short, traffic};
use super::target::{Target, Unit};
use super::values::negations;

/// What a function takes of a processor that has its scalar.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Estimate {
    /// What moves between registers and memory.
    pub traffic: Traffic,
    /// Instructions of one run, without those of functions that are called.
    pub instructions: usize,
    /// Bytes of stack, without those of functions that are called.
    pub stack: usize,
    /// Bytes of code.
    pub code: usize,
    /// Bytes of constants.
    pub constants: usize,
    /// The longest chain of operations, in cycles.
    pub cycles: usize,
}

/// What surrounds the arithmetic of a function.
struct Frame {
    /// Integer registers that are saved: pointers that calls must not lose, and
    /// what every frame has.
    words: usize,
    /// Registers for floats that are saved for the caller.
    saved: usize,
    /// Bytes of values.
    values: usize,
}

/// What a function of so many arguments takes.
pub fn estimate(
    flat: &Flat,
    target: &Target,
    unit: &Unit,
    scalar: ScalarType,
    arguments: usize,
) -> Estimate {
    let traffic = traffic(flat, target, unit);
    // Without an instruction for them, fused operations are calls.
    let software = match unit.cycles.fma {
        Some(_) => 0,
        None => flat.count(Deed::Fused),
    };
    let calls = flat.count(Deed::Call) + flat.count(Deed::CallTogether) + software;
    // What calls must not lose: where the arguments are, and the results go.
    let pointers = if calls > 0 { arguments + 1 } else { 0 };
    let values = (traffic.slots + arrays(flat)) * bytes(scalar);
    let frame = Frame::of(target, unit, &traffic, pointers, values);
    let stored = traffic.spills + traffic.angles + flat.count(Deed::Return);
    let moved = traffic.loads + traffic.constants + traffic.copies + stored;
    let instructions = flat.operations() - software - traffic.merged
        + negations(flat)
        + moved
        + calls
        + pointers
        + frame.instructions(target);
    Estimate {
        traffic,
        instructions,
        stack: frame.bytes(target),
        code: (instructions as f64 * target.bytes).round() as usize,
        constants: table(flat, target, unit) * bytes(scalar),
        cycles: depth::in_cycles(flat, unit.cycles),
    }
}

impl Frame {
    fn of(
        target: &Target,
        unit: &Unit,
        traffic: &Traffic,
        pointers: usize,
        values: usize,
    ) -> Frame {
        let free = unit.registers - unit.kept;
        let saved = traffic.registers.saturating_sub(free);
        // While there are any, a compiler takes another register of 64 bits for each
        // value, also where it would hold two.
        let saved = saved.max(traffic.over_calls).min(target.restored);
        let words = match pointers + values + saved {
            0 => 0,
            _ => target.frame + pointers,
        };
        Frame {
            words,
            saved,
            values,
        }
    }

    fn bytes(&self, target: &Target) -> usize {
        let bytes = self.words * target.word + self.saved * 8 + self.values;
        match bytes {
            0 => target.returns,
            _ => (target.returns + bytes).next_multiple_of(target.alignment),
        }
    }

    /// What makes it and leaves it, and the return.
    fn instructions(&self, target: &Target) -> usize {
        let saves = self.words.div_ceil(target.saves) + self.saved.div_ceil(target.saves);
        let moves = usize::from(self.values > 0);
        2 * (saves + moves) + 1
    }
}

/// What the arrays hold by which all sines are computed together: the angles, and
/// a sine and a cosine of each.
fn arrays(flat: &Flat) -> usize {
    let items = flat.items.iter();
    let calls = items.filter(|item| item.deed == Deed::CallTogether);
    calls.map(|item| 3 * item.reads.len()).sum()
}

/// Bytes of a scalar.
pub fn bytes(scalar: ScalarType) -> usize {
    match scalar {
        ScalarType::F64 => 8,
        ScalarType::F32 => 4,
    }
}

/// Constants that stand in a table.
fn table(flat: &Flat, target: &Target, unit: &Unit) -> usize {
    if !unit.constants_in_table {
        return 0;
    }
    let stands = |home: &&Home| match home {
        Home::Constant(constant) => !(target.short_constants && is_short(*constant)),
        _ => false,
    };
    flat.values.iter().filter(stands).count()
}
