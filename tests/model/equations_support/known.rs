//! Residues that know their zeros and ones.

use dalembert_model::scalar::field::Field;
use dalembert_model::scalar::{Divide, Scalar};

use crate::equations_slips::added;

/// A residue that knows when it is zero or one: which axes are parallel, or meet, is a matter of
/// structure. One of its additions slips where a test asks for it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Known(pub Field);

impl Scalar for Known {
    fn zero() -> Self {
        Known(Field::ZERO)
    }
    fn one() -> Self {
        Known(Field::ONE)
    }
    fn add(&self, other: &Self) -> Self {
        Known(added(self.0, other.0))
    }
    fn mul(&self, other: &Self) -> Self {
        Known(self.0.mul(&other.0))
    }
    fn neg(&self) -> Self {
        Known(self.0.neg())
    }
    fn half(&self) -> Self {
        Known(self.0.half())
    }
    fn is_zero(&self) -> bool {
        self.0 == Field::ZERO
    }
    fn is_one(&self) -> bool {
        self.0 == Field::ONE
    }
}

impl Divide for Known {
    fn div(&self, other: &Self) -> Self {
        Known(self.0.div(&other.0))
    }
}
