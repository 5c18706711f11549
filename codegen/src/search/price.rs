//! The price that the search minimises: operations, in hundredths of an addition.

use crate::dag::Dag;
use crate::program::{Counts, Operation};

/// Between equal sums the one with fewer multiplications is cheaper; a division costs as much as five
/// operations, sine and cosine of an angle as much as twenty.
const MUL: u64 = 101;
const ADD: u64 = 100;
const DIV: u64 = 500;
pub(super) const SINCOS: u64 = 2000;

pub(super) fn operation(operation: Operation) -> u64 {
    match operation {
        Operation::Mul | Operation::Fused => MUL,
        Operation::Add | Operation::Sub => ADD,
        Operation::Div => DIV,
    }
}

/// Returns the price of counts; a fused operation costs as much as its product and its sum.
pub fn price(counts: &Counts) -> u64 {
    let [mul, add] = [counts.mul, counts.add].map(|n| (n + counts.fma) as u64);
    MUL * mul + ADD * add + DIV * counts.div as u64 + SINCOS * counts.sincos as u64
}

/// Returns the price of a graph's outputs.
pub fn cost(dag: &Dag) -> u64 {
    price(&dag.counts())
}
