//! How long the longest chain of operations is.

use super::flat::{Deed, Flat};
use super::target::Cycles;

/// The longest chain in which every operation reads the one before, by what
/// each operation counts from this one of its operands. It begins behind the calls of sines: how long these
/// take is not known here.
fn chain(flat: &Flat, weight: impl Fn(Deed, usize) -> usize) -> usize {
    let mut depths = vec![0; flat.values.len()];
    for item in &flat.items {
        let reads = item.reads.iter().enumerate();
        let through = reads.map(|(side, &value)| depths[value] + weight(item.deed, side));
        let depth = match item.deed {
            Deed::Call | Deed::CallTogether => 0,
            _ => through.max().unwrap_or(0),
        };
        for &value in &item.writes {
            depths[value] = depth;
        }
    }
    depths.into_iter().max().unwrap_or(0)
}

/// In operations.
pub fn in_operations(flat: &Flat) -> usize {
    chain(flat, |deed, _| {
        usize::from(matches!(deed, Deed::Operation(_) | Deed::Fused))
    })
}

/// In the cycles of a processor; a change of sign takes none.
pub fn in_cycles(flat: &Flat, cycles: Cycles) -> usize {
    chain(flat, |deed, side| match deed {
        Deed::Operation(operation) => cycles.of(operation),
        Deed::Fused if side < 2 => cycles.fused().factor,
        Deed::Fused => cycles.fused().addend,
        _ => 0,
    })
}
