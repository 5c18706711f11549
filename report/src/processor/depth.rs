//! How long the longest chain of operations is.

use super::flat::{Deed, Flat};
use super::target::Cycles;

/// The longest chain in which every operation reads the one before, by what
/// each operation counts. It begins behind the calls of sines: how long these
/// take is not known here.
fn chain(flat: &Flat, mut weight: impl FnMut(Deed) -> usize) -> usize {
    let mut depths = vec![0; flat.values.len()];
    for item in &flat.items {
        let before = item.reads.iter().map(|&value| depths[value]).max();
        let depth = match item.deed {
            Deed::Call | Deed::CallTogether => 0,
            deed => before.unwrap_or(0) + weight(deed),
        };
        for &value in &item.writes {
            depths[value] = depth;
        }
    }
    depths.into_iter().max().unwrap_or(0)
}

/// In operations.
pub fn in_operations(flat: &Flat) -> usize {
    chain(flat, |deed| usize::from(matches!(deed, Deed::Operation(_))))
}

/// In the cycles of a processor; a change of sign takes none.
pub fn in_cycles(flat: &Flat, cycles: Cycles) -> usize {
    chain(flat, |deed| match deed {
        Deed::Operation(operation) => cycles.of(operation),
        _ => 0,
    })
}
