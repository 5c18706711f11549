//! How long the longest chain of operations is.

use super::flat::{Deed, Flat};

/// Counts the operations of the longest chain in which every operation reads the one
/// before. It begins behind the calls of sines: how long these take is not known here.
pub fn in_operations(flat: &Flat) -> usize {
    let mut depths = vec![0; flat.values.len()];
    for item in &flat.items {
        let through = item.reads.iter().map(|&value| depths[value]).max();
        let depth = match item.deed {
            Deed::Call | Deed::CallTogether => 0,
            Deed::Operation(_) | Deed::Fused => through.unwrap_or(0) + 1,
            Deed::Negation | Deed::Return => through.unwrap_or(0),
        };
        for &value in &item.writes {
            depths[value] = depth;
        }
    }
    depths.into_iter().max().unwrap_or(0)
}
