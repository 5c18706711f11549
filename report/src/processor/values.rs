//! What is alive, and what could be one operation.

use dalembert_codegen::workspace::program::Operation;

use super::flat::{Deed, Flat, Home};

/// Returns the greatest number of values that are alive at once: computed, and read or
/// returned later. Entries of arguments and constants are none of them: they
/// stay where they are. Results are alive until they are returned, all at the
/// end.
pub fn most_alive(flat: &Flat) -> usize {
    let uses = flat.uses();
    let is_computed = |value: &&usize| {
        matches!(flat.values[**value], Home::Computed | Home::Array) && !uses[**value].is_empty()
    };
    let (mut alive, mut most) = (0, 0);
    for (place, item) in flat.items.iter().enumerate() {
        let mut read = item.reads.clone();
        read.sort_unstable();
        read.dedup();
        let last = |value: &&usize| uses[**value].last() == Some(&place);
        alive -= read.iter().filter(is_computed).filter(last).count();
        alive += item.writes.iter().filter(is_computed).count();
        most = most.max(alive);
    }
    most
}

/// Finds, for every item that is a sum or difference, the product that it alone reads, if one of
/// its operands is such: together they are what a processor can do in one instruction. Of two
/// products it is the left one.
pub fn merged_products(flat: &Flat) -> Vec<Option<usize>> {
    let uses = flat.uses();
    let mut product = vec![false; flat.values.len()];
    let items = flat
        .items
        .iter()
        .map(|item| match (item.deed, &item.reads[..]) {
            (Deed::Operation(Operation::Mul), _) => {
                for &value in &item.writes {
                    product[value] = uses[value].len() == 1;
                }
                None
            }
            // x + x is no sum with a product: both operands are it.
            (Deed::Operation(Operation::Add | Operation::Sub), &[left, right]) if left != right => {
                [left, right].into_iter().find(|&value| product[value])
            }
            _ => None,
        });
    items.collect()
}
