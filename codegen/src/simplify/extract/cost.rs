//! What operations cost.

use crate::program::{AngleSum, Counts};
use crate::simplify::classes::Operator;

/// What operations cost, in hundredths of an operation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct CostModel {
    /// A multiplication.
    pub mul: u64,
    /// An addition.
    pub add: u64,
    /// A division.
    pub div: u64,
    /// A sine/cosine pair of a joint's angle.
    pub sincos: u64,
    /// A sine/cosine pair of a sum of angles, where it is to be had at all.
    pub sum_sincos: u64,
}

impl CostModel {
    /// Fewest operations; of equal sums the one with fewer multiplications;
    /// an angle costs as much as twenty operations, a division as five. The pair of a sum is to be
    /// had only if somebody asked for it, and then costs a little less than the
    /// six operations that form it from other pairs.
    pub(crate) const OPERATIONS: CostModel = CostModel {
        mul: 101,
        add: 100,
        div: 500,
        sincos: 2000,
        sum_sincos: 300,
    };

    /// Prices where a tolerance is given: polynomials for a pair of sine and cosine then take about
    /// eight operations.
    pub(crate) const TOLERATED: CostModel = CostModel {
        sincos: 800,
        ..CostModel::OPERATIONS
    };

    /// Returns the sine and cosine of an angle, apart from forming it.
    pub(crate) fn angle(&self, angle: AngleSum) -> u64 {
        match angle.additions() {
            0 => self.sincos,
            _ => self.sum_sincos,
        }
    }

    /// Returns the price of code with these operations and angles.
    pub(crate) fn price(&self, counts: &Counts, angles: impl Iterator<Item = AngleSum>) -> u64 {
        let angles: u64 = angles.map(|angle| self.angle(angle)).sum();
        // A fused operation is the product and the sum that it stands for.
        let [mul, add] = [counts.mul, counts.add].map(|n| (n + counts.fma) as u64);
        let div = counts.div as u64;
        mul * self.mul + add * self.add + div * self.div + angles
    }

    /// Returns the cheapest operation.
    pub(super) fn least(&self) -> u64 {
        self.mul.min(self.add).min(self.div)
    }

    pub(super) fn way(&self, operator: Operator) -> u64 {
        match operator {
            Operator::Product => self.mul,
            Operator::Sum | Operator::Difference => self.add,
            Operator::Quotient => self.div,
        }
    }
}
